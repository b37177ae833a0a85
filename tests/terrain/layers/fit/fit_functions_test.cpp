#include "terrain/layers/fit/fit_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "terrain/layers/fit/fit_measures.h"
#include "tests/terrain/layers/fit/made_up.h"

namespace belvedere {
namespace {

using made_up::two_classes;

double mean_of(const LayerSamples& function) {
  return std::accumulate(function.samples.begin(), function.samples.end(), 0.0) / (256.0 * 255.0);
}

TEST(FitProduct, RecoversKnownFunctions) {
  const ClassFunctions fitted = fit_product(two_classes(60'000));
  ASSERT_EQ(fitted.order, (std::vector<int>{0, 1}));
  for (const int s : {40, 100, 128, 150, 200, 240}) {
    const auto sample = static_cast<std::uint8_t>(s);
    // b and the functions share one constant: the product at a place where the other function is nearly 1.
    const double low = fitted.bias[1] * fitted.functions[1][0].samples[sample] / 255.0 * fitted.functions[1][1].samples[60] / 255.0 *
                       fitted.functions[1][2].samples[128] / 255.0;
    EXPECT_NEAR(low, made_up::rising(sample) * made_up::falling(60), 0.05) << s;
    const double other = fitted.bias[1] * fitted.functions[1][0].samples[220] / 255.0 * fitted.functions[1][1].samples[sample] / 255.0 *
                         fitted.functions[1][2].samples[128] / 255.0;
    EXPECT_NEAR(other, made_up::rising(220) * made_up::falling(sample), 0.05) << s;
  }
  // What says nothing gets a level function.
  for (int s = 16; s < 240; ++s)
    EXPECT_NEAR(fitted.functions[1][2].samples[static_cast<std::size_t>(s)], fitted.functions[1][2].samples[128], 12) << s;
}

TEST(FitProduct, SharesAreAsOftenAsTheClass) {
  const FitCells cells = two_classes(40'000);
  const std::vector<double> mean = mean_shares(predict_shares(fit_product(cells), cells.inputs), cells.labels);
  const double truth = static_cast<double>(count_labels(cells.labels, 2)[1]) / 40'000.0;
  EXPECT_NEAR(mean[1], truth, 0.01);
  EXPECT_NEAR(mean[0] + mean[1], 1.0, 1e-5);
}

TEST(FitAdditive, RecoversSharesAndBeatsChance) {
  const FitCells cells = two_classes(60'000);
  const FitCells judged = two_classes(20'000, 8);
  const ClassShares shares = predict_shares(fit_additive(cells), judged.inputs);
  double off = 0.0;
  for (std::size_t i = 0; i != judged.size(); ++i)
    off += std::abs(static_cast<double>(shares.of(i)[1]) - made_up::rising(judged.inputs[0][i]) * made_up::falling(judged.inputs[1][i]));
  // A sum of logits is no product: .03 is what the form itself is off.
  EXPECT_LT(off / 20'000.0, 0.04);
  EXPECT_GT(measure_classes(shares, judged.labels).mean_auc, 0.85);
}

TEST(FitFunctions, ClassesWithoutCellsCoverNothing) {
  FitCells cells = two_classes(5'000);
  cells.classes = 3;
  for (const ClassFunctions& fitted : {fit_product(cells), fit_additive(cells)}) {
    const ClassShares shares = predict_shares(fitted, cells.inputs);
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

TEST(HistogramFunctions, MeanIsOneHalfOrSaturated) {
  FitCells cells = two_classes(30'000);
  const ClassFunctions wide = histogram_functions(cells);
  EXPECT_EQ(wide.saturated, 0);
  for (std::size_t k = 0; k != 2; ++k)
    for (const LayerSamples& function : wide.functions[k]) EXPECT_NEAR(mean_of(function), 0.5, 0.003);
  // Class 1 in less than half of the first input's range: no scale brings its mean to 1/2.
  for (std::size_t i = 0; i != cells.size(); ++i) cells.labels[i] = cells.inputs[0][i] >= 200 ? 1 : 0;
  const ClassFunctions narrow = histogram_functions(cells);
  EXPECT_EQ(narrow.saturated, 1);
  EXPECT_EQ(narrow.functions[1][0].samples[220], 255);
  EXPECT_EQ(narrow.functions[1][0].samples[100], 0);
}

TEST(PredictShares, LaterLayersLieOverEarlierOnes) {
  LayerSamples all;
  all.samples.fill(255);
  const ClassFunctions functions{LayerModel::product, {1, 0, 2}, {0.5, 1.0, 0.25}, std::vector(3, std::vector<LayerSamples>{all}), 0};
  const ClassShares shares = predict_shares(functions, {{0}});
  EXPECT_FLOAT_EQ(shares.of(0)[2], 0.25F);
  EXPECT_FLOAT_EQ(shares.of(0)[0], 0.75F * 0.5F);
  EXPECT_FLOAT_EQ(shares.of(0)[1], 0.75F * 0.5F);
}

}  // namespace
}  // namespace belvedere
