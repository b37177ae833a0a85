#include "terrain/layers/fit/fit_measures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace belvedere {
namespace {

TEST(AreaUnderCurve, CountsPairsByHand) {
  const std::vector<float> scores = {0.1F, 0.4F, 0.4F, 0.8F};
  const std::vector<std::uint8_t> own = {0, 1, 0, 1};
  // (.4 over .1: 1) + (.4 beside .4: ½) + (.8 over both: 2) of 4.
  EXPECT_DOUBLE_EQ(area_under_curve(scores, own), 3.5 / 4.0);
  EXPECT_TRUE(std::isnan(area_under_curve(scores, std::vector<std::uint8_t>(4, 1))));
}

// Pairs 1, 7, 17 and 25 of the table of Sharma, Wu and Dalal (2005).
TEST(ColourDifference, PublishedPairs) {
  EXPECT_NEAR(colour_difference({50.0, 2.6772, -79.7751}, {50.0, 0.0, -82.7485}), 2.0425, 1e-4);
  EXPECT_NEAR(colour_difference({50.0, 0.0, 0.0}, {50.0, -1.0, 2.0}), 2.3669, 1e-4);
  EXPECT_NEAR(colour_difference({50.0, 2.5, 0.0}, {73.0, 25.0, -18.0}), 27.1492, 1e-4);
  EXPECT_NEAR(colour_difference({60.2574, -34.0099, 36.2677}, {60.4626, -34.1751, 39.4387}), 1.2644,
              1e-4);
}

TEST(MeasureClasses, ConfusionByHand) {
  const ClassShares shares{2, {0.9F, 0.1F, 0.2F, 0.8F, 0.6F, 0.4F, 0.7F, 0.3F}};
  const std::vector<std::uint8_t> labels = {0, 1, 1, no_class};
  const ClassMeasures measures = measure_classes(shares, labels);
  EXPECT_EQ(measures.cells, 3U);
  EXPECT_NEAR(measures.accuracy, 2.0 / 3.0, 1e-12);
  EXPECT_EQ(measures.counts[1][0], 1U);
  EXPECT_NEAR(measures.iou[0], 0.5, 1e-12);
  EXPECT_NEAR(measures.iou[1], 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(measures.mean_auc, 1.0);
}

TEST(BlockDifference, OfMeansAndOnlyOfUsedCells) {
  const Grid<glm::vec3> picture(4, 2, glm::vec3(100.0F));
  Grid<glm::vec3> other = picture;
  other(0, 0).x = 140.0F;
  other(1, 0).x = 60.0F;  // the mean of the block stays
  Grid<std::uint8_t> use(4, 2, 1);
  EXPECT_NEAR(block_difference(picture, other, &use, 2).mean, 0.0, 1e-9);
  EXPECT_GT(block_difference(picture, other, &use, 1).mean, 1.0);
  use(0, 0) = use(1, 0) = 0;
  EXPECT_NEAR(block_difference(picture, other, &use, 1).mean, 0.0, 1e-9);
  EXPECT_EQ(block_difference(picture, other, &use, 1).blocks, 6U);
}

TEST(GradientEnergy, OfLevelColourIsNone) {
  Grid<glm::vec3> picture(5, 5, glm::vec3(80.0F));
  EXPECT_EQ(gradient_energy(picture, nullptr), 0.0);
  picture(2, 2).y = 180.0F;
  EXPECT_GT(gradient_energy(picture, nullptr), 0.0);
}

}  // namespace
}  // namespace belvedere
