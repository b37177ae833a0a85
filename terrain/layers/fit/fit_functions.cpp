#include "terrain/layers/fit/fit_functions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "base/math_exact.h"
#include "base/parallel.h"
#include "terrain/layers/fit/minimize.h"

namespace belvedere {
namespace {

constexpr std::size_t samples = 256;
constexpr std::size_t chunk_cells = 8192;  // fixed, so that sums do not hang on threads
constexpr double level_weight = 1e-5;      // of squared knots: what the data leave open goes to 0

// How samples read knots: linear between knot `first` and the next.
struct KnotPlace {
  std::size_t first = 0;
  double next = 0.0;  // weight of the next one
};
std::array<KnotPlace, samples> knot_places(std::size_t knots) {
  std::array<KnotPlace, samples> places;
  for (std::size_t i = 0; i != samples; ++i) {
    const double at = layer_sample_place(static_cast<int>(i)) * static_cast<double>(knots - 1);
    places[i].first = std::min(static_cast<std::size_t>(at), knots - 2);
    places[i].next = at - static_cast<double>(places[i].first);
  }
  return places;
}

double sigmoid(double x) { return x >= 0.0 ? 1.0 / (1.0 + exact::exp(-x)) : exact::exp(x) / (1.0 + exact::exp(x)); }

// Adds the penalty of one function's knots, `stride` apart, and its gradient.
double add_penalty(const double* knots, double* gradient, std::size_t count, std::size_t stride, double roughness) {
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

// Sum of logarithms of numbers in [1e-12, 1e12] by products of 16 of them: a logarithm costs as much as the rest of a cell.
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

// Sums over fixed chunks of cells, each into numbers of its own, added up in their order.
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

std::vector<std::uint8_t> rows_of(const FitCells& cells, const std::vector<std::uint32_t>& indices) {
  const std::size_t inputs = cells.inputs.size();
  std::vector<std::uint8_t> rows(indices.size() * inputs);
  for (std::size_t i = 0; i != indices.size(); ++i)
    for (std::size_t a = 0; a != inputs; ++a) rows[i * inputs + a] = cells.inputs[a][indices[i]];
  return rows;
}

LayerSamples constant_samples(std::uint8_t value) {
  LayerSamples function;
  function.samples.fill(value);
  return function;
}

// One class against those under it. Cells of the class itself need no more than their histograms: their loss is -ln b - Σ ln F.
class ProductLoss {
 public:
  ProductLoss(const FitCells& cells, const std::vector<std::uint32_t>& own, const std::vector<std::uint32_t>& under,
              const FitFunctionParameters& parameters)
      : inputs_(cells.inputs.size()),
        knots_(static_cast<std::size_t>(parameters.knots)),
        roughness_(parameters.roughness),
        own_count_(static_cast<double>(own.size())),
        cells_(static_cast<double>(own.size() + under.size())),
        places_(knot_places(knots_)),
        own_(inputs_ * samples, 0.0),
        rows_(rows_of(cells, under)),
        under_(under.size()) {
    for (const std::uint32_t i : own)
      for (std::size_t a = 0; a != inputs_; ++a) own_[a * samples + cells.inputs[a][i]] += 1.0;
  }

  double operator()(std::span<const double> x, std::span<double> gradient) const {
    const double b = sigmoid(x[0]);
    std::vector<double> f(inputs_ * samples);
    double loss = -own_count_ * exact::log(b);
    for (std::size_t a = 0; a != inputs_; ++a)
      for (std::size_t i = 0; i != samples; ++i) {
        const std::size_t at = 1 + a * knots_ + places_[i].first;
        const double e = x[at] + places_[i].next * (x[at + 1] - x[at]);
        f[a * samples + i] = std::max(sigmoid(e), 1e-12);
        if (own_[a * samples + i] != 0.0) loss -= own_[a * samples + i] * exact::log(f[a * samples + i]);
      }
    // d loss / d(-ln C): 1 a cell of the class, -C / (1 - C) a cell under it; the last number is the sum over all.
    std::vector<double> slopes(inputs_ * samples + 1, 0.0);
    loss += chunked_sum(under_, slopes, [&](std::size_t begin, std::size_t end, double* sums) {
      LogSum logs;
      for (std::size_t c = begin; c != end; ++c) {
        const std::uint8_t* row = rows_.data() + c * inputs_;
        double coverage = b;
        for (std::size_t a = 0; a != inputs_; ++a) coverage *= f[a * samples + row[a]];
        const double rest = std::max(1.0 - coverage, 1e-9);
        logs.add(rest);
        const double slope = coverage / rest;
        for (std::size_t a = 0; a != inputs_; ++a) sums[a * samples + row[a]] -= slope;
        sums[inputs_ * samples] -= slope;
      }
      return -logs.take();
    });
    std::fill(gradient.begin(), gradient.end(), 0.0);
    gradient[0] = -(1.0 - b) * (own_count_ + slopes.back()) / cells_;
    double penalty = 0.0;
    for (std::size_t a = 0; a != inputs_; ++a) {
      for (std::size_t i = 0; i != samples; ++i) {
        const double slope = -(1.0 - f[a * samples + i]) * (own_[a * samples + i] + slopes[a * samples + i]) / cells_;
        const std::size_t at = 1 + a * knots_ + places_[i].first;
        gradient[at] += (1.0 - places_[i].next) * slope;
        gradient[at + 1] += places_[i].next * slope;
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
  std::array<KnotPlace, samples> places_;
  std::vector<double> own_;         // cells of the class by input and sample
  std::vector<std::uint8_t> rows_;  // samples of the cells under it, a row each
  std::size_t under_;
};

// All classes together; numbers are [input][knot or sample][class].
class AdditiveLoss {
 public:
  AdditiveLoss(const FitCells& cells, const std::vector<std::uint32_t>& use, const FitFunctionParameters& parameters)
      : inputs_(cells.inputs.size()),
        knots_(static_cast<std::size_t>(parameters.knots)),
        classes_(static_cast<std::size_t>(cells.classes)),
        roughness_(parameters.roughness),
        places_(knot_places(knots_)),
        rows_(rows_of(cells, use)),
        labels_(use.size()),
        prior_(classes_, 1.0) {
    for (std::size_t i = 0; i != use.size(); ++i) {
      labels_[i] = cells.labels[use[i]];
      prior_[labels_[i]] += 1.0;
    }
    for (double& p : prior_) p /= static_cast<double>(use.size());
  }
  const std::vector<double>& prior() const { return prior_; }

  double operator()(std::span<const double> x, std::span<double> gradient) const {
    std::vector<double> factors(inputs_ * samples * classes_);
    for (std::size_t a = 0; a != inputs_; ++a)
      for (std::size_t i = 0; i != samples; ++i)
        for (std::size_t k = 0; k != classes_; ++k) {
          const double* at = &x[(a * knots_ + places_[i].first) * classes_ + k];
          // ± 30 an input keeps products of 20 of them finite; fitted tables stay within ± 10.
          factors[(a * samples + i) * classes_ + k] = exact::exp(std::clamp(at[0] + places_[i].next * (at[classes_] - at[0]), -30.0, 30.0));
        }
    const double cells = static_cast<double>(labels_.size());
    std::vector<double> slopes(factors.size(), 0.0);
    const double loss = chunked_sum(labels_.size(), slopes, [&](std::size_t begin, std::size_t end, double* sums) {
      LogSum logs;
      std::vector<double> share(classes_);
      for (std::size_t c = begin; c != end; ++c) {
        const std::uint8_t* row = rows_.data() + c * inputs_;
        for (std::size_t k = 0; k != classes_; ++k) share[k] = prior_[k];
        for (std::size_t a = 0; a != inputs_; ++a) {
          const double* of = &factors[(a * samples + row[a]) * classes_];
          for (std::size_t k = 0; k != classes_; ++k) share[k] *= of[k];
        }
        double total = 0.0;
        for (std::size_t k = 0; k != classes_; ++k) total += share[k];
        const double scale = 1.0 / total;
        for (std::size_t k = 0; k != classes_; ++k) share[k] *= scale;
        logs.add(std::max(share[labels_[c]], 1e-12));
        share[labels_[c]] -= 1.0;
        for (std::size_t a = 0; a != inputs_; ++a) {
          double* to = sums + (a * samples + row[a]) * classes_;
          for (std::size_t k = 0; k != classes_; ++k) to[k] += share[k];
        }
      }
      return -logs.take();
    });
    std::fill(gradient.begin(), gradient.end(), 0.0);
    double penalty = 0.0;
    for (std::size_t a = 0; a != inputs_; ++a) {
      for (std::size_t i = 0; i != samples; ++i)
        for (std::size_t k = 0; k != classes_; ++k) {
          const double slope = slopes[(a * samples + i) * classes_ + k] / cells;
          double* at = &gradient[(a * knots_ + places_[i].first) * classes_ + k];
          at[0] += (1.0 - places_[i].next) * slope;
          at[classes_] += places_[i].next * slope;
        }
      for (std::size_t k = 0; k != classes_; ++k)
        penalty += add_penalty(&x[a * knots_ * classes_ + k], &gradient[a * knots_ * classes_ + k], knots_, classes_, roughness_);
    }
    return loss / cells + penalty;
  }

 private:
  std::size_t inputs_;
  std::size_t knots_;
  std::size_t classes_;
  double roughness_;
  std::array<KnotPlace, samples> places_;
  std::vector<std::uint8_t> rows_;
  std::vector<std::uint8_t> labels_;
  std::vector<double> prior_;
};

std::uint8_t to_byte(double unit) { return static_cast<std::uint8_t>(std::floor(255.0 * std::clamp(unit, 0.0, 1.0) + 0.5)); }

// What is fitted are knots: the file holds them alone, and the samples follow from their bytes.
void set_knots(LayerSamples& function, std::vector<std::uint8_t> knots) {
  function.samples = samples_of_knots(knots);
  function.knots = std::move(knots);
}

double value_of(const LayerSamples& function, std::size_t sample) {
  return function.at_0 + (function.at_255 - function.at_0) * static_cast<double>(function.samples[sample]) / 255.0;
}

}  // namespace

std::vector<int> by_falling_area(const std::vector<std::size_t>& counts) {
  std::vector<int> order(counts.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return counts[static_cast<std::size_t>(a)] > counts[static_cast<std::size_t>(b)]; });
  return order;
}

ClassFunctions fit_product(const FitCells& cells, const FitFunctionParameters& parameters) {
  const auto classes = static_cast<std::size_t>(cells.classes);
  const std::size_t inputs = cells.inputs.size();
  const std::vector<std::uint32_t> use = draw_labelled(cells.labels, parameters.most);
  ClassFunctions fitted{LayerModel::product, by_falling_area(count_labels(cells.labels, cells.classes)), std::vector<double>(classes, 1.0),
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
    const ProductLoss loss(cells, of_class[k], under, parameters);
    const MinimizeResult best = minimize(std::move(start), std::cref(loss), {.steps = parameters.steps});
    fitted.bias[k] = sigmoid(best.at[0]);
    for (std::size_t a = 0; a != inputs; ++a) {
      std::vector<std::uint8_t> bytes(knots);
      for (std::size_t j = 0; j != knots; ++j) bytes[j] = to_byte(sigmoid(best.at[1 + a * knots + j]));
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
  const AdditiveLoss loss(cells, draw_labelled(cells.labels, parameters.most), parameters);
  const MinimizeResult best = minimize(std::vector<double>(inputs * knots * classes, 0.0), std::cref(loss), {.steps = parameters.steps});
  ClassFunctions fitted{LayerModel::additive, by_falling_area(count_labels(cells.labels, cells.classes)), std::vector<double>(classes),
                        std::vector(classes, std::vector(inputs, LayerSamples{})), 0};
  for (std::size_t k = 0; k != classes; ++k) {
    fitted.bias[k] = exact::log(loss.prior()[k]);
    for (std::size_t a = 0; a != inputs; ++a) {
      std::vector<double> values(knots);
      for (std::size_t j = 0; j != knots; ++j) values[j] = best.at[(a * knots + j) * classes + k];
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      LayerSamples& function = fitted.functions[k][a];
      // Thousandths are enough to tell shares apart, and short in a file.
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
  ClassFunctions made{LayerModel::product, by_falling_area(count_labels(cells.labels, cells.classes)), std::vector<double>(classes, 1.0),
                      std::vector(classes, std::vector(inputs, LayerSamples{})), 0};
  const int reach = static_cast<int>(std::ceil(4.0 * parameters.smoothing));
  std::vector<double> kernel;
  for (int d = -reach; d <= reach; ++d)
    kernel.push_back(reach == 0 ? 1.0 : exact::exp(-0.5 * d * d / (parameters.smoothing * parameters.smoothing)));
  for (std::size_t k = 0; k != classes; ++k)
    for (std::size_t a = 0; a != inputs; ++a) {
      std::array<double, samples> count{};
      for (std::size_t i = 0; i != cells.size(); ++i)
        if (cells.labels[i] == k) count[cells.inputs[a][i]] += 1.0;
      std::array<double, samples> smooth{};
      for (int i = 0; i != static_cast<int>(samples); ++i)
        for (int d = -reach; d <= reach; ++d)
          smooth[static_cast<std::size_t>(i)] +=
              kernel[static_cast<std::size_t>(d + reach)] * count[static_cast<std::size_t>(std::clamp(i + d, 0, 255))];
      LayerSamples& function = made.functions[k][a];
      const auto occupied = static_cast<std::size_t>(std::count_if(smooth.begin(), smooth.end(), [](double v) { return v > 0.0; }));
      if (2 * occupied <= samples) {
        ++made.saturated;
        for (std::size_t i = 0; i != samples; ++i) function.samples[i] = smooth[i] > 0.0 ? 255 : 0;
        continue;
      }
      // The mean of min(1, scale · h) rises with the scale: bisection of its logarithm.
      double low = 1e-9;
      double high = 1e15;
      for (int step = 0; step != 120; ++step) {
        const double scale = std::sqrt(low * high);
        double mean = 0.0;
        for (const double v : smooth) mean += std::min(1.0, scale * v) / static_cast<double>(samples);
        (mean < 0.5 ? low : high) = scale;
      }
      for (std::size_t i = 0; i != samples; ++i) function.samples[i] = to_byte(low * smooth[i]);
    }
  return made;
}

namespace {

// Coverage of a product, shares of a sum.
ClassShares evaluate(const ClassFunctions& functions, const std::vector<std::vector<std::uint8_t>>& inputs) {
  const std::size_t classes = functions.bias.size();
  const std::size_t cells = inputs.empty() ? 0 : inputs[0].size();
  const bool product = functions.model == LayerModel::product;
  std::vector<double> table(inputs.size() * samples * classes);  // factors, [input][sample][class]
  for (std::size_t k = 0; k != classes; ++k)
    for (std::size_t a = 0; a != inputs.size(); ++a)
      for (std::size_t i = 0; i != samples; ++i) {
        const double value = value_of(functions.functions[k][a], i);
        table[(a * samples + i) * classes + k] = product ? value : exact::exp(std::clamp(value, -30.0, 30.0));
      }
  ClassShares shares{static_cast<int>(classes), std::vector<float>(cells * classes)};
  parallel_ranges(cells, chunk_cells, [&](std::size_t begin, std::size_t end) {
    std::vector<double> of(classes);
    for (std::size_t c = begin; c != end; ++c) {
      for (std::size_t k = 0; k != classes; ++k) of[k] = product ? functions.bias[k] : exact::exp(functions.bias[k]);
      for (std::size_t a = 0; a != inputs.size(); ++a) {
        const double* factor = &table[(a * samples + inputs[a][c]) * classes];
        for (std::size_t k = 0; k != classes; ++k) of[k] *= factor[k];
      }
      float* to = &shares.values[c * classes];
      if (product) {
        for (std::size_t k = 0; k != classes; ++k) to[k] = static_cast<float>(of[k]);
        to[static_cast<std::size_t>(functions.order[0])] = 1.0F;
      } else {
        double total = 0.0;
        for (const double v : of) total += v;
        for (std::size_t k = 0; k != classes; ++k) to[k] = static_cast<float>(of[k] / total);
      }
    }
  });
  return shares;
}

}  // namespace

ClassShares predict_coverage(const ClassFunctions& functions, const std::vector<std::vector<std::uint8_t>>& inputs) {
  return evaluate(functions, inputs);
}

ClassShares predict_shares(const ClassFunctions& functions, const std::vector<std::vector<std::uint8_t>>& inputs) {
  ClassShares shares = evaluate(functions, inputs);
  if (functions.model != LayerModel::product) return shares;
  const std::size_t classes = functions.bias.size();
  for (std::size_t c = 0; c != shares.size(); ++c) {
    // What is seen of each: those painted later lie over those before; what is left is ground.
    float* of = &shares.values[c * classes];
    double rest = 1.0;
    for (std::size_t rank = classes; rank-- != 0;) {
      const auto k = static_cast<std::size_t>(functions.order[rank]);
      const auto coverage = static_cast<double>(of[k]);
      of[k] = static_cast<float>(coverage * rest);
      rest *= 1.0 - coverage;
    }
  }
  return shares;
}

}  // namespace belvedere
