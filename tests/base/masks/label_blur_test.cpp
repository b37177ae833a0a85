#include "base/masks/label_blur.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "base/random.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

TEST(BlurWithinLabels, LetsNothingThroughABorder) {
  Grid<std::uint8_t> labels(40, 20, 1);
  for (const auto [x, y] : test::cells(40, 20))
    labels(x, y) = x + y < 30 ? 1 : 2;  // slanted: the boxes around the two overlap
  Grid<float> values(40, 20);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = labels[i] == 1 ? 0.25F : 0.75F;
  const Grid<float> blurred = blur_within_labels(values, labels, 5.0);
  for (std::size_t i = 0; i < values.size(); ++i) ASSERT_NEAR(blurred[i], values[i], 1e-5) << i;
}

TEST(BlurWithinLabels, IsTheMeanOfGaussianWeightsOverTheOwnTexels) {
  Grid<std::uint8_t> labels(31, 1, 3);
  labels(9, 0) = labels(20, 0) = no_label;
  Grid<float> values(31, 1, 0.F);
  for (int x = 0; x < 31; ++x) values(x, 0) = static_cast<float>(random_uniform(7, x, 0));
  const double sigma = 2.0;
  const Grid<float> blurred = blur_within_labels(values, labels, sigma);
  for (const int at : {0, 8, 15, 21}) {
    double sum = 0.0;
    double weight = 0.0;
    for (int x = 0; x < 31; ++x) {
      if (labels(x, 0) != 3 || std::abs(x - at) > 8) continue;
      const double w = std::exp(-0.5 * (x - at) * (x - at) / (sigma * sigma));
      sum += w * values(x, 0);
      weight += w;
    }
    EXPECT_NEAR(blurred(at, 0), sum / weight, 1e-4) << at;
  }
  EXPECT_EQ(blurred(9, 0), 0.F);
}

using testing::ElementsAre;

// 1 1 0
// 0 0 1
// 1 0 1
Grid<int> three_patches() {
  Grid<int> cells(3, 3, 0);
  cells(0, 0) = cells(1, 0) = cells(2, 1) = cells(0, 2) = cells(2, 2) = 1;
  return cells;
}

TEST(LabelPatches, AreConnectedBySidesInTheOrderOfTheirFirstCells) {
  const LabelPatches<int> patches = find_patches(three_patches(), [](int) { return false; });
  EXPECT_THAT(patches.labels, ElementsAre(1, 0, 0, 1, 1));
  EXPECT_THAT(patches.sizes, ElementsAre(2, 1, 3, 2, 1));
  EXPECT_EQ(patches.of_cell(1, 2), patches.of_cell(0, 1));
}

TEST(LabelPatches, AreConnectedByCornersWhereAsked) {
  const LabelPatches<int> patches =
      find_patches(three_patches(), [](int label) { return label == 1; });
  EXPECT_THAT(patches.labels, ElementsAre(1, 0, 0, 1));
  EXPECT_THAT(patches.sizes, ElementsAre(4, 1, 3, 1));
}

}  // namespace
}  // namespace belvedere
