#include "terrain/layers/fit/fit_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numeric>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/parallel.h"
#include "terrain/layers/fit/fit_measures.h"
#include "terrain/layers/layer_coverage.h"
#include "tests/terrain/layers/fit/synthetic.h"

namespace belvedere {
namespace {

using synthetic::two_classes;

double mean_of(const LayerSamples& function) {
  return std::accumulate(function.samples.begin(), function.samples.end(), 0.0) / (256.0 * 255.0);
}

// The share of each class in each cell, by the functions as stored in a file.
ClassShares shares_of(const ClassFunctions& functions,
                      const std::vector<std::vector<std::uint8_t>>& inputs) {
  SurfaceLayers layers;
  layers.model = functions.model;
  const std::vector<std::string> names = layer_input_names();
  const int cells = static_cast<int>(inputs[0].size());
  std::vector<Grid<float>> values;
  for (std::size_t a = 0; a != inputs.size(); ++a) {
    layers.inputs.push_back({names[a], 0.0, 256.0});
    values.emplace_back(cells, 1);
    for (std::size_t i = 0; i != inputs[a].size(); ++i)
      values[a][i] = static_cast<float>(inputs[a][i]) + 0.5F;  // where that sample stands
  }
  for (const int k : functions.order) {
    SurfaceLayer& layer = layers.layers.emplace_back();
    layer.name = "class " + std::to_string(k);
    set_functions(layer, functions, static_cast<std::size_t>(k));
  }
  const LayerProgram program = compile_layers(layers);
  const std::vector<Grid<float>> seen =
      layer_shares(program, layer_coverage(program, values, {}, {0, 0, cells, 1}, 0));
  ClassShares shares{static_cast<int>(functions.order.size()),
                     std::vector<float>(inputs[0].size() * functions.order.size(), 0.0F)};
  for (std::size_t of = 0; of != seen.size(); ++of) {
    const auto k = static_cast<std::size_t>(
        functions.order[of == 0 ? 0 : of - 1]);  // bare ground is that of the first
    for (std::size_t i = 0; i != inputs[0].size(); ++i)
      shares.values[i * functions.order.size() + k] += seen[of][i];
  }
  return shares;
}

TEST(FitProduct, RecoversKnownFunctions) {
  const ClassFunctions fitted = fit_product(two_classes(60'000));
  ASSERT_EQ(fitted.order, (std::vector<int>{0, 1}));
  for (const int s : {40, 100, 128, 150, 200, 240}) {
    const auto sample = static_cast<std::uint8_t>(s);
    // b and the functions share one constant: the product at a position where the other function is
    // nearly 1.
    const double low = fitted.bias[1] * fitted.functions[1][0].samples[sample] / 255.0 *
                       fitted.functions[1][1].samples[60] / 255.0 *
                       fitted.functions[1][2].samples[128] / 255.0;
    EXPECT_NEAR(low, synthetic::rising(sample) * synthetic::falling(60), 0.05) << s;
    const double other = fitted.bias[1] * fitted.functions[1][0].samples[220] / 255.0 *
                         fitted.functions[1][1].samples[sample] / 255.0 *
                         fitted.functions[1][2].samples[128] / 255.0;
    EXPECT_NEAR(other, synthetic::rising(220) * synthetic::falling(sample), 0.05) << s;
  }
  // An input without information gets a constant function.
  for (int s = 16; s < 240; ++s)
    EXPECT_NEAR(fitted.functions[1][2].samples[static_cast<std::size_t>(s)],
                fitted.functions[1][2].samples[128], 12)
        << s;
}

TEST(FitProduct, SharesAreAsOftenAsTheClass) {
  const FitCells cells = two_classes(40'000);
  const std::vector<double> mean =
      mean_shares(shares_of(fit_product(cells), cells.inputs), cells.labels);
  const double truth = static_cast<double>(count_labels(cells.labels, 2)[1]) / 40'000.0;
  EXPECT_NEAR(mean[1], truth, 0.01);
  EXPECT_NEAR(mean[0] + mean[1], 1.0, 1e-5);
}

TEST(FitAdditive, RecoversSharesAndBeatsChance) {
  const FitCells cells = two_classes(60'000);
  const FitCells evaluated = two_classes(20'000, 8);
  const ClassShares shares = shares_of(fit_additive(cells), evaluated.inputs);
  double off = 0.0;
  for (std::size_t i = 0; i != evaluated.size(); ++i)
    off += std::abs(static_cast<double>(shares.of(i)[1]) -
                    synthetic::rising(evaluated.inputs[0][i]) *
                        synthetic::falling(evaluated.inputs[1][i]));
  // A sum of logits is not a product: the form itself is off by .03.
  EXPECT_LT(off / 20'000.0, 0.04);
  EXPECT_GT(measure_classes(shares, evaluated.labels).mean_auc, 0.85);
}

TEST(FitFunctions, ClassesWithoutCellsCoverNothing) {
  FitCells cells = two_classes(5'000);
  cells.classes = 3;
  for (const ClassFunctions& fitted : {fit_product(cells), fit_additive(cells)}) {
    const ClassShares shares = shares_of(fitted, cells.inputs);
    for (std::size_t i = 0; i != 100; ++i) EXPECT_LT(shares.of(i)[2], 0.02F);
  }
}

TEST(FitFunctions, OneThreadOrTwoGiveTheSameBits) {
  const FitCells cells = two_classes(30'000);
  const auto fit = [&](int threads) {
    const ThreadLimit limit(threads);
    return std::pair(fit_product(cells), fit_additive(cells));
  };
  const auto one = fit(1);
  const auto two = fit(2);
  EXPECT_EQ(one.first.bias, two.first.bias);
  for (std::size_t a = 0; a != 3; ++a) {
    EXPECT_EQ(one.first.functions[1][a].samples, two.first.functions[1][a].samples);
    EXPECT_EQ(one.second.functions[1][a].samples, two.second.functions[1][a].samples);
    EXPECT_EQ(one.second.functions[1][a].at_255, two.second.functions[1][a].at_255);
  }
}

// Class 1 once at each value of the input up to 127 and three times above: v and 3 v with a mean of
// 1/2 is 63.75 and 191.25 of 255.
TEST(HistogramFunctions, AreTheHistogramScaledToItsMean) {
  const auto function = [](int times) {
    FitCells cells;
    cells.classes = 2;
    cells.inputs = {{}};
    for (int value = 0; value != 256; ++value)
      for (int i = 0; i != (value < 128 ? 1 : times); ++i) {
        cells.inputs[0].push_back(static_cast<std::uint8_t>(value));
        cells.labels.push_back(1);
      }
    cells.inputs[0].push_back(0);
    cells.labels.push_back(0);
    return histogram_functions(cells, {.smoothing = 0.0}).functions[1][0];
  };
  const LayerSamples three = function(3);
  EXPECT_NEAR(three.samples[10], 64, 1);
  EXPECT_NEAR(three.samples[127], 64, 1);
  EXPECT_NEAR(three.samples[128], 191, 1);
  EXPECT_NEAR(mean_of(three), 0.5, 0.003);
  const LayerSamples hundred = function(100);
  EXPECT_EQ(hundred.samples[200], 252);  // 100 / 101 of 255
  EXPECT_EQ(hundred.samples[100], 3);
}

TEST(HistogramFunctions, MeanIsOneHalfOrSaturated) {
  FitCells cells = two_classes(30'000);
  const ClassFunctions wide = histogram_functions(cells);
  EXPECT_EQ(wide.saturated, 0);
  for (std::size_t k = 0; k != 2; ++k)
    for (const LayerSamples& function : wide.functions[k])
      EXPECT_NEAR(mean_of(function), 0.5, 0.003);
  // Class 1 in less than half of the first input's range: no scale gives a mean of 1/2.
  for (std::size_t i = 0; i != cells.size(); ++i)
    cells.labels[i] = cells.inputs[0][i] >= 200 ? 1 : 0;
  const ClassFunctions narrow = histogram_functions(cells);
  EXPECT_EQ(narrow.saturated, 1);
  EXPECT_EQ(narrow.functions[1][0].samples[220], 255);
  EXPECT_EQ(narrow.functions[1][0].samples[100], 0);
}

TEST(SetFunctions, WhatSaysNothingIsLeftOut) {
  LayerSamples all;
  all.samples.fill(255);
  LayerSamples half = all;
  half.samples[0] = 127;
  SurfaceLayer layer;
  set_functions(layer, {LayerModel::product, {0}, {0.5}, {{all, half}}, 0}, 0);
  EXPECT_EQ(layer.noise.bias, 0.5);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(layer.functions[0]));
  EXPECT_TRUE(std::holds_alternative<LayerSamples>(layer.functions[1]));
  // In a sum a constant function is a number, which the bias absorbs.
  all.at_255 = 3.0;
  set_functions(layer, {LayerModel::additive, {0}, {0.5}, {{all, half}}, 0}, 0);
  EXPECT_EQ(layer.noise.bias, 3.5);
  EXPECT_TRUE(std::holds_alternative<std::monostate>(layer.functions[0]));
  EXPECT_TRUE(std::holds_alternative<LayerSamples>(layer.functions[1]));
}

TEST(Minimize, RosenbrocksValleyEndsAtItsFloor) {
  // f = Σ 100 (x_{i+1} - x_i²)² + (1 - x_i)²: 0 at (1, 1, …), a valley whose walls are a thousand
  // times steeper than its floor.
  const ValueAndGradient rosenbrock = [](std::span<const double> x, std::span<double> gradient) {
    double value = 0.0;
    for (double& g : gradient) g = 0.0;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const double off = x[i + 1] - x[i] * x[i];
      value += 100.0 * off * off + (1.0 - x[i]) * (1.0 - x[i]);
      gradient[i] += -400.0 * off * x[i] - 2.0 * (1.0 - x[i]);
      gradient[i + 1] += 200.0 * off;
    }
    return value;
  };
  const MinimizeResult result =
      minimize({-1.2, 1.0, -0.7, 2.0}, rosenbrock, {.steps = 300, .tolerance = 0.0});
  EXPECT_LT(result.value, 1e-18);
  for (const double x : result.at) EXPECT_NEAR(x, 1.0, 1e-8);
  EXPECT_LT(result.evaluations, 200);  // of plain steepest descent it takes tens of thousands
}

TEST(Minimize, QuadraticOfKnownSolution) {
  // f = Σ c_i (x_i - i)² / 2 with curvatures over four decades.
  const ValueAndGradient bowl = [](std::span<const double> x, std::span<double> gradient) {
    double value = 0.0;
    for (std::size_t i = 0; i != x.size(); ++i) {
      const double c = std::pow(10.0, static_cast<double>(i % 5));
      const double off = x[i] - static_cast<double>(i);
      gradient[i] = c * off;
      value += 0.5 * c * off * off;
    }
    return value;
  };
  const MinimizeResult result =
      minimize(std::vector<double>(20, 0.0), bowl, {.steps = 200, .tolerance = 0.0});
  for (std::size_t i = 0; i != result.at.size(); ++i)
    EXPECT_NEAR(result.at[i], static_cast<double>(i), 1e-7);
}

TEST(Minimize, StaysWhereThereIsNothingToGain) {
  const ValueAndGradient flat = [](std::span<const double>, std::span<double> gradient) {
    for (double& g : gradient) g = 0.0;
    return 3.0;
  };
  const MinimizeResult result = minimize({1.0, 2.0}, flat);
  EXPECT_EQ(result.steps, 0);
  EXPECT_EQ(result.at, (std::vector<double>{1.0, 2.0}));
  EXPECT_EQ(result.value, 3.0);
}

TEST(Minimize, TakesNoMoreStepsThanAllowed) {
  const ValueAndGradient quartic = [](std::span<const double> x, std::span<double> gradient) {
    gradient[0] = 4.0 * x[0] * x[0] * x[0];
    return x[0] * x[0] * x[0] * x[0];
  };
  EXPECT_LE(minimize({10.0}, quartic, {.steps = 3, .tolerance = 0.0}).steps, 3);
}

}  // namespace
}  // namespace belvedere
