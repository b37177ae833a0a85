#include "terrain/layers/fit/fit_functions.h"

#include <lbfgs.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/math_exact.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

struct Search {
  const ValueAndGradient& function;
  MinimizeResult result = {};
};

double evaluate(void* search, const double* x, double* gradient, int count, double /*step*/) {
  auto& [function, result] = *static_cast<Search*>(search);
  const double value =
      function({x, static_cast<std::size_t>(count)}, {gradient, static_cast<std::size_t>(count)});
  if (++result.evaluations == 1) result.value = value;
  return value;
}

int count_step(void* search, const double* /*x*/, const double* /*gradient*/, double value,
               double /*x_norm*/, double /*gradient_norm*/, double /*step*/, int /*count*/,
               int steps, int /*evaluations*/) {
  MinimizeResult& result = static_cast<Search*>(search)->result;
  result.value = value;
  result.steps = steps;
  return 0;
}

}  // namespace

MinimizeResult minimize(const std::vector<double>& start, const ValueAndGradient& function,
                        const MinimizeParameters& parameters) {
  const int count = static_cast<int>(start.size());
  // The library's vector instructions require its own allocation.
  const std::unique_ptr<double, void (*)(double*)> x(lbfgs_malloc(count), lbfgs_free);
  if (x == nullptr) throw Error(ErrorKind::limit, "minimize", "no memory");
  std::copy(start.begin(), start.end(), x.get());
  lbfgs_parameter_t how;
  lbfgs_parameter_init(&how);
  how.m = 10;
  how.epsilon = 0.0;  // no test of the gradient: only the gain per step decides
  how.past = 1;
  how.delta = parameters.tolerance;
  how.max_iterations = parameters.steps;
  Search search{function};
  // The return value is the reason for stopping. A failed line search leaves the previous point,
  // which is the minimum within numerical precision.
  lbfgs(count, x.get(), nullptr, evaluate, count_step, &search, &how);
  search.result.at.assign(x.get(), x.get() + count);
  return search.result;
}

namespace {

// The objectives of fit_product and fit_additive: the negative log likelihood per cell plus a
// roughness penalty. The same bits for any threads: sums use fixed chunks of cells.

double sigmoid(double x);  // 1 / (1 + e^-x)

struct KnotParameters {
  int count = 32;  // of each function, linear between them; 2…256
  double roughness =
      6e-4;  // weight of squared differences of neighbouring knots (in units of logits), ≥ 0
};

constexpr std::size_t table_samples = 256;
constexpr std::size_t chunk_cells = 8192;  // fixed, so that sums do not depend on threads
constexpr double level_weight = 1e-5;      // of squared knots: undetermined knots go to 0

// Linear interpolation of samples between knot `first` and the next.
struct KnotPosition {
  std::size_t first = 0;
  double next = 0.0;  // weight of the next one
};
std::array<KnotPosition, table_samples> knot_positions(std::size_t knots) {
  std::array<KnotPosition, table_samples> positions;
  for (std::size_t i = 0; i != table_samples; ++i) {
    const double at = layer_sample_place(static_cast<int>(i)) * static_cast<double>(knots - 1);
    positions[i].first = std::min(static_cast<std::size_t>(at), knots - 2);
    positions[i].next = at - static_cast<double>(positions[i].first);
  }
  return positions;
}

// Adds the roughness penalty of one function's knots, `stride` apart, and its gradient.
double add_penalty(const double* knots, double* gradient, std::size_t count, std::size_t stride,
                   double roughness) {
  double penalty = 0.0;
  for (std::size_t j = 0; j != count; ++j) {
    const double level = knots[j * stride];
    penalty += level_weight * level * level;
    gradient[j * stride] += 2.0 * level_weight * level;
    if (j == 0) continue;
    const double difference = level - knots[(j - 1) * stride];
    penalty += roughness * difference * difference;
    gradient[j * stride] += 2.0 * roughness * difference;
    gradient[(j - 1) * stride] -= 2.0 * roughness * difference;
  }
  return penalty;
}

// Sum of logarithms of numbers in [1e-12, 1e12] by products of 16 of them: a logarithm costs as
// much as the rest of a cell.
class LogSum {
 public:
  void add(double factor) {
    product_ *= factor;
    if (++factors_ == 16) flush();
  }
  double take() {
    flush();
    return sum_;
  }

 private:
  void flush() {
    sum_ += exact::log(product_);
    product_ = 1.0;
    factors_ = 0;
  }
  double sum_ = 0.0;
  double product_ = 1.0;
  int factors_ = 0;
};

// Sums over fixed chunks of cells, added in their order.
template <class F>
double chunked_sum(std::size_t cells, std::vector<double>& totals, F&& of_chunk) {
  const std::size_t chunks = (cells + chunk_cells - 1) / chunk_cells;
  std::vector<std::vector<double>> sums(chunks, std::vector<double>(totals.size(), 0.0));
  std::vector<double> values(chunks, 0.0);
  parallel_ranges(chunks, std::size_t{1}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c != end; ++c)
      values[c] = of_chunk(c * chunk_cells, std::min(cells, (c + 1) * chunk_cells), sums[c].data());
  });
  double value = 0.0;
  for (std::size_t c = 0; c != chunks; ++c) {
    value += values[c];
    for (std::size_t i = 0; i != totals.size(); ++i) totals[i] += sums[c][i];
  }
  return value;
}

std::vector<std::uint8_t> rows_of(const FitCells& cells,
                                  const std::vector<std::uint32_t>& indices) {
  const std::size_t inputs = cells.inputs.size();
  std::vector<std::uint8_t> rows(indices.size() * inputs);
  for (std::size_t i = 0; i != indices.size(); ++i)
    for (std::size_t a = 0; a != inputs; ++a) rows[i * inputs + a] = cells.inputs[a][indices[i]];
  return rows;
}

// One class against those under it. For cells of the class itself the histograms suffice: their
// loss is -ln b - Σ ln F.
class ProductLoss {
 public:
  ProductLoss(const FitCells& cells, const std::vector<std::uint32_t>& own,
              const std::vector<std::uint32_t>& under, const KnotParameters& knots)
      : inputs_(cells.inputs.size()),
        knots_(static_cast<std::size_t>(knots.count)),
        roughness_(knots.roughness),
        own_count_(static_cast<double>(own.size())),
        cells_(static_cast<double>(own.size() + under.size())),
        positions_(knot_positions(knots_)),
        own_(inputs_ * table_samples, 0.0),
        rows_(rows_of(cells, under)),
        under_(under.size()) {
    for (const std::uint32_t i : own)
      for (std::size_t a = 0; a != inputs_; ++a)
        own_[a * table_samples + cells.inputs[a][i]] += 1.0;
  }

  double operator()(std::span<const double> x, std::span<double> gradient) const {
    const double b = sigmoid(x[0]);
    std::vector<double> f(inputs_ * table_samples);
    double loss = -own_count_ * exact::log(b);
    for (std::size_t a = 0; a != inputs_; ++a)
      for (std::size_t i = 0; i != table_samples; ++i) {
        const std::size_t at = 1 + a * knots_ + positions_[i].first;
        const double e = x[at] + positions_[i].next * (x[at + 1] - x[at]);
        f[a * table_samples + i] = std::max(sigmoid(e), 1e-12);
        if (own_[a * table_samples + i] != 0.0)
          loss -= own_[a * table_samples + i] * exact::log(f[a * table_samples + i]);
      }
    // d loss / d(-ln C): 1 for a cell of the class, -C / (1 - C) for a cell under it; the last
    // number is the sum over all.
    std::vector<double> slopes(inputs_ * table_samples + 1, 0.0);
    loss += chunked_sum(under_, slopes, [&](std::size_t begin, std::size_t end, double* sums) {
      LogSum logs;
      for (std::size_t c = begin; c != end; ++c) {
        const std::uint8_t* row = rows_.data() + c * inputs_;
        double coverage = b;
        for (std::size_t a = 0; a != inputs_; ++a) coverage *= f[a * table_samples + row[a]];
        const double rest = std::max(1.0 - coverage, 1e-9);
        logs.add(rest);
        const double slope = coverage / rest;
        for (std::size_t a = 0; a != inputs_; ++a) sums[a * table_samples + row[a]] -= slope;
        sums[inputs_ * table_samples] -= slope;
      }
      return -logs.take();
    });
    std::fill(gradient.begin(), gradient.end(), 0.0);
    gradient[0] = -(1.0 - b) * (own_count_ + slopes.back()) / cells_;
    double penalty = 0.0;
    for (std::size_t a = 0; a != inputs_; ++a) {
      for (std::size_t i = 0; i != table_samples; ++i) {
        const double slope = -(1.0 - f[a * table_samples + i]) *
                             (own_[a * table_samples + i] + slopes[a * table_samples + i]) / cells_;
        const std::size_t at = 1 + a * knots_ + positions_[i].first;
        gradient[at] += (1.0 - positions_[i].next) * slope;
        gradient[at + 1] += positions_[i].next * slope;
      }
      penalty += add_penalty(&x[1 + a * knots_], &gradient[1 + a * knots_], knots_, 1, roughness_);
    }
    return loss / cells_ + penalty;
  }

 private:
  std::size_t inputs_;
  std::size_t knots_;
  double roughness_;
  double own_count_;
  double cells_;
  std::array<KnotPosition, table_samples> positions_;
  std::vector<double> own_;         // cells of the class by input and sample
  std::vector<std::uint8_t> rows_;  // samples of the cells under it, a row each
  std::size_t under_;
};

// All classes together; the parameters are [input][knot or sample][class].
class AdditiveLoss {
 public:
  AdditiveLoss(const FitCells& cells, const std::vector<std::uint32_t>& use,
               std::vector<double> prior, const KnotParameters& knots)
      : inputs_(cells.inputs.size()),
        knots_(static_cast<std::size_t>(knots.count)),
        classes_(static_cast<std::size_t>(cells.classes)),
        roughness_(knots.roughness),
        positions_(knot_positions(knots_)),
        rows_(rows_of(cells, use)),
        labels_(use.size()),
        prior_(std::move(prior)) {
    for (std::size_t i = 0; i != use.size(); ++i) labels_[i] = cells.labels[use[i]];
  }

  double operator()(std::span<const double> x, std::span<double> gradient) const {
    std::vector<double> factors(inputs_ * table_samples * classes_);
    for (std::size_t a = 0; a != inputs_; ++a)
      for (std::size_t i = 0; i != table_samples; ++i)
        for (std::size_t k = 0; k != classes_; ++k) {
          const double* at = &x[(a * knots_ + positions_[i].first) * classes_ + k];
          // A range of ± 30 per input keeps products of 20 of them finite; fitted tables stay
          // within ± 10.
          factors[(a * table_samples + i) * classes_ + k] = exact::exp(
              std::clamp(at[0] + positions_[i].next * (at[classes_] - at[0]), -30.0, 30.0));
        }
    const double cells = static_cast<double>(labels_.size());
    std::vector<double> slopes(factors.size(), 0.0);
    const double loss =
        chunked_sum(labels_.size(), slopes, [&](std::size_t begin, std::size_t end, double* sums) {
          LogSum logs;
          std::vector<double> share(classes_);
          for (std::size_t c = begin; c != end; ++c) {
            const std::uint8_t* row = rows_.data() + c * inputs_;
            for (std::size_t k = 0; k != classes_; ++k) share[k] = prior_[k];
            for (std::size_t a = 0; a != inputs_; ++a) {
              const double* of = &factors[(a * table_samples + row[a]) * classes_];
              for (std::size_t k = 0; k != classes_; ++k) share[k] *= of[k];
            }
            double total = 0.0;
            for (std::size_t k = 0; k != classes_; ++k) total += share[k];
            const double scale = 1.0 / total;
            for (std::size_t k = 0; k != classes_; ++k) share[k] *= scale;
            logs.add(std::max(share[labels_[c]], 1e-12));
            share[labels_[c]] -= 1.0;
            for (std::size_t a = 0; a != inputs_; ++a) {
              double* to = sums + (a * table_samples + row[a]) * classes_;
              for (std::size_t k = 0; k != classes_; ++k) to[k] += share[k];
            }
          }
          return -logs.take();
        });
    std::fill(gradient.begin(), gradient.end(), 0.0);
    double penalty = 0.0;
    for (std::size_t a = 0; a != inputs_; ++a) {
      for (std::size_t i = 0; i != table_samples; ++i)
        for (std::size_t k = 0; k != classes_; ++k) {
          const double slope = slopes[(a * table_samples + i) * classes_ + k] / cells;
          double* at = &gradient[(a * knots_ + positions_[i].first) * classes_ + k];
          at[0] += (1.0 - positions_[i].next) * slope;
          at[classes_] += positions_[i].next * slope;
        }
      for (std::size_t k = 0; k != classes_; ++k)
        penalty += add_penalty(&x[a * knots_ * classes_ + k], &gradient[a * knots_ * classes_ + k],
                               knots_, classes_, roughness_);
    }
    return loss / cells + penalty;
  }

 private:
  std::size_t inputs_;
  std::size_t knots_;
  std::size_t classes_;
  double roughness_;
  std::array<KnotPosition, table_samples> positions_;
  std::vector<std::uint8_t> rows_;
  std::vector<std::uint8_t> labels_;
  std::vector<double> prior_;
};

double sigmoid(double x) {
  return x >= 0.0 ? 1.0 / (1.0 + exact::exp(-x)) : exact::exp(x) / (1.0 + exact::exp(x));
}

// For one class (`own`, indices of cells) against those under it. Parameters: the logit of its
// bias, then the logits of its knots by input.
ValueAndGradient product_loss(const FitCells& cells, const std::vector<std::uint32_t>& own,
                              const std::vector<std::uint32_t>& under,
                              const KnotParameters& knots) {
  return ProductLoss(cells, own, under, knots);
}

// Shares of the classes among the used cells, with one extra count each.
std::vector<double> class_prior(const FitCells& cells, const std::vector<std::uint32_t>& use) {
  std::vector<double> prior(static_cast<std::size_t>(cells.classes), 1.0);
  for (const std::uint32_t i : use) prior[cells.labels[i]] += 1.0;
  for (double& p : prior) p /= static_cast<double>(use.size());
  return prior;
}

// For all classes together: shares are proportional to the prior times e to the sum of functions.
// Parameters: [input][knot][class].
ValueAndGradient additive_loss(const FitCells& cells, const std::vector<std::uint32_t>& use,
                               std::vector<double> prior, const KnotParameters& knots) {
  return AdditiveLoss(cells, use, std::move(prior), knots);
}

constexpr std::size_t samples = 256;

LayerSamples constant_samples(std::uint8_t value) {
  LayerSamples function;
  function.samples.fill(value);
  return function;
}

std::uint8_t to_byte(double unit) {
  return static_cast<std::uint8_t>(std::floor(255.0 * std::clamp(unit, 0.0, 1.0) + 0.5));
}

// Only knots are fitted: the file contains them as bytes, and the samples follow.
void set_knots(LayerSamples& function, std::vector<std::uint8_t> knots) {
  function.samples = samples_of_knots(knots);
  function.knots = std::move(knots);
}

}  // namespace

std::vector<int> by_falling_area(const std::vector<std::size_t>& counts) {
  std::vector<int> order(counts.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return counts[static_cast<std::size_t>(a)] > counts[static_cast<std::size_t>(b)];
  });
  return order;
}

ClassFunctions fit_product(const FitCells& cells, const FitFunctionParameters& parameters) {
  const auto classes = static_cast<std::size_t>(cells.classes);
  const std::size_t inputs = cells.inputs.size();
  const std::vector<std::uint32_t> use = draw_labelled(cells.labels, parameters.max);
  ClassFunctions fitted{LayerModel::product,
                        by_falling_area(count_labels(cells.labels, cells.classes)),
                        std::vector<double>(classes, 1.0),
                        std::vector(classes, std::vector(inputs, constant_samples(255))), 0};
  std::vector<std::vector<std::uint32_t>> of_class(classes);
  for (const std::uint32_t i : use) of_class[cells.labels[i]].push_back(i);
  std::vector<std::uint32_t> under = of_class[static_cast<std::size_t>(fitted.order[0])];
  const auto knots = static_cast<std::size_t>(parameters.knots);
  for (std::size_t rank = 1; rank != classes; ++rank) {
    const auto k = static_cast<std::size_t>(fitted.order[rank]);
    if (of_class[k].empty()) {
      fitted.bias[k] = 0.0;
      continue;
    }
    std::vector<double> start(1, 0.0);
    start.resize(1 + inputs * knots, 1.0);
    const ValueAndGradient loss =
        product_loss(cells, of_class[k], under, {parameters.knots, parameters.roughness});
    const MinimizeResult best = minimize(std::move(start), loss, {.steps = parameters.steps});
    fitted.bias[k] = sigmoid(best.at[0]);
    for (std::size_t a = 0; a != inputs; ++a) {
      std::vector<std::uint8_t> bytes(knots);
      for (std::size_t j = 0; j != knots; ++j)
        bytes[j] = to_byte(sigmoid(best.at[1 + a * knots + j]));
      set_knots(fitted.functions[k][a], std::move(bytes));
    }
    under.insert(under.end(), of_class[k].begin(), of_class[k].end());
  }
  return fitted;
}

ClassFunctions fit_additive(const FitCells& cells, const FitFunctionParameters& parameters) {
  const auto classes = static_cast<std::size_t>(cells.classes);
  const std::size_t inputs = cells.inputs.size();
  const auto knots = static_cast<std::size_t>(parameters.knots);
  const std::vector<std::uint32_t> use = draw_labelled(cells.labels, parameters.max);
  const std::vector<double> prior = class_prior(cells, use);
  const ValueAndGradient loss =
      additive_loss(cells, use, prior, {parameters.knots, parameters.roughness});
  const MinimizeResult best = minimize(std::vector<double>(inputs * knots * classes, 0.0), loss,
                                       {.steps = parameters.steps});
  ClassFunctions fitted{
      LayerModel::additive, by_falling_area(count_labels(cells.labels, cells.classes)),
      std::vector<double>(classes), std::vector(classes, std::vector(inputs, LayerSamples{})), 0};
  for (std::size_t k = 0; k != classes; ++k) {
    fitted.bias[k] = exact::log(prior[k]);
    for (std::size_t a = 0; a != inputs; ++a) {
      std::vector<double> values(knots);
      for (std::size_t j = 0; j != knots; ++j) values[j] = best.at[(a * knots + j) * classes + k];
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      LayerSamples& function = fitted.functions[k][a];
      // Three decimals are precise enough for shares, and short in a file.
      function.at_0 = std::floor(*low * 1000.0) / 1000.0;
      function.at_255 = std::ceil(*high * 1000.0) / 1000.0;
      std::vector<std::uint8_t> bytes(knots);
      for (std::size_t j = 0; j != knots && function.at_255 > function.at_0; ++j)
        bytes[j] = to_byte((values[j] - function.at_0) / (function.at_255 - function.at_0));
      set_knots(function, std::move(bytes));
    }
  }
  return fitted;
}

ClassFunctions histogram_functions(const FitCells& cells, const HistogramParameters& parameters) {
  const auto classes = static_cast<std::size_t>(cells.classes);
  const std::size_t inputs = cells.inputs.size();
  ClassFunctions made{LayerModel::product,
                      by_falling_area(count_labels(cells.labels, cells.classes)),
                      std::vector<double>(classes, 1.0),
                      std::vector(classes, std::vector(inputs, LayerSamples{})), 0};
  const int reach = static_cast<int>(std::ceil(4.0 * parameters.smoothing));
  std::vector<double> kernel;
  for (int d = -reach; d <= reach; ++d)
    kernel.push_back(
        reach == 0 ? 1.0
                   : exact::exp(-0.5 * d * d / (parameters.smoothing * parameters.smoothing)));
  for (std::size_t k = 0; k != classes; ++k)
    for (std::size_t a = 0; a != inputs; ++a) {
      std::array<double, samples> count{};
      for (std::size_t i = 0; i != cells.size(); ++i)
        if (cells.labels[i] == k) count[cells.inputs[a][i]] += 1.0;
      std::array<double, samples> smooth{};
      for (int i = 0; i != static_cast<int>(samples); ++i)
        for (int d = -reach; d <= reach; ++d)
          smooth[static_cast<std::size_t>(i)] +=
              kernel[static_cast<std::size_t>(d + reach)] *
              count[static_cast<std::size_t>(std::clamp(i + d, 0, 255))];
      LayerSamples& function = made.functions[k][a];
      const auto occupied = static_cast<std::size_t>(
          std::count_if(smooth.begin(), smooth.end(), [](double v) { return v > 0.0; }));
      if (2 * occupied <= samples) {
        ++made.saturated;
        for (std::size_t i = 0; i != samples; ++i) function.samples[i] = smooth[i] > 0.0 ? 255 : 0;
        continue;
      }
      // The mean of min(1, scale · h) increases with the scale: bisection of its logarithm.
      double low = 1e-9;
      double high = 1e15;
      for (int step = 0; step != 120; ++step) {
        const double scale = std::sqrt(low * high);
        double mean = 0.0;
        for (const double v : smooth)
          mean += std::min(1.0, scale * v) / static_cast<double>(samples);
        (mean < 0.5 ? low : high) = scale;
      }
      for (std::size_t i = 0; i != samples; ++i) function.samples[i] = to_byte(low * smooth[i]);
    }
  return made;
}

void set_functions(SurfaceLayer& layer, const ClassFunctions& functions, std::size_t of) {
  constexpr double min_span = 0.02;
  layer.noise.bias = functions.bias[of];
  layer.functions.clear();
  for (const LayerSamples& function : functions.functions[of]) {
    const auto [low, high] = std::minmax_element(function.samples.begin(), function.samples.end());
    const double step = (function.at_255 - function.at_0) / 255.0;
    if (functions.model == LayerModel::product && function.at_255 == 1.0 && *low == 255) {
      layer.functions.emplace_back();
    } else if (functions.model == LayerModel::additive && step * (*high - *low) < min_span) {
      layer.noise.bias += function.at_0 + step * 0.5 * (*low + *high);
      layer.functions.emplace_back();
    } else {
      layer.functions.emplace_back(function);
    }
  }
}

}  // namespace belvedere
