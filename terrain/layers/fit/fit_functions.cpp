#include "terrain/layers/fit/fit_functions.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/math_exact.h"
#include "terrain/layers/fit/fit_losses.h"
#include "terrain/layers/fit/minimize.h"

namespace belvedere {
namespace {

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
