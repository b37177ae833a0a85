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

TEST(HueSaturation, KnownColours) {
  EXPECT_NEAR(hue_saturation_of({255, 0, 0}).hue_deg, 0.0, 1e-12);
  EXPECT_NEAR(hue_saturation_of({0, 255, 0}).hue_deg, 120.0, 1e-12);
  EXPECT_NEAR(hue_saturation_of({0, 0, 255}).hue_deg, 240.0, 1e-12);
  EXPECT_NEAR(hue_saturation_of({255, 0, 255}).hue_deg, 300.0, 1e-12);
  EXPECT_NEAR(hue_saturation_of({200, 100, 100}).saturation, 0.5, 1e-12);
  EXPECT_NEAR(hue_saturation_of({51, 20, 0}).value, 0.2, 1e-12);
  EXPECT_TRUE(hue_saturation_of({100, 112, 104}).grey);
  EXPECT_FALSE(hue_saturation_of({100, 113, 104}).grey);
}

// Shadow scales all channels: it must not move anything in the plane.
TEST(HueSaturation, PlaneIsInvariantToScalingValue) {
  for (const auto& [r, g, b] : {std::array{200.0, 120.0, 60.0}, std::array{60.0, 160.0, 90.0},
                                std::array{90.0, 60.0, 220.0}}) {
    const PlanePosition full = hue_saturation_place(hue_saturation_of({r, g, b}));
    for (const double shade : {0.2, 0.5, 0.9}) {
      const PlanePosition dim =
          hue_saturation_place(hue_saturation_of({shade * r, shade * g, shade * b}));
      EXPECT_NEAR(dim.x, full.x, 1e-12);
      EXPECT_NEAR(dim.y, full.y, 1e-12);
    }
  }
}

TEST(HueSaturation, GreysLieNearTheMiddle) {
  const PlanePosition grey = hue_saturation_place(hue_saturation_of({30, 20, 25}));
  EXPECT_LT(std::hypot(grey.x, grey.y), 0.11);  // .3 of a saturation of 1/3
}

TEST(SmoothChroma, KeepsLumaAndLevelsBlocks) {
  // Blocks of 8 cells whose chroma jumps while luma is constant.
  Grid<glm::vec3> picture(64, 64);
  for (int y = 0; y != 64; ++y)
    for (int x = 0; x != 64; ++x) {
      const float jump = (x / 8 + y / 8) % 2 == 0 ? 6.0F : -6.0F;
      const float luma = 100.0F + static_cast<float>(x);
      picture(x, y).x = luma + jump;
      picture(x, y).z = luma - jump;
      picture(x, y).y = luma + (-0.299F * jump + 0.114F * jump) / 0.587F;
    }
  const Grid<glm::vec3> smooth = smooth_chroma(picture, 6.0);
  for (const auto& [x, y] : {std::pair{20, 20}, std::pair{31, 40}, std::pair{44, 17}}) {
    const float before =
        0.299F * picture(x, y).x + 0.587F * picture(x, y).y + 0.114F * picture(x, y).z;
    const float after = 0.299F * smooth(x, y).x + 0.587F * smooth(x, y).y + 0.114F * smooth(x, y).z;
    EXPECT_NEAR(after, before, 1e-3F);
    EXPECT_LT(std::abs(smooth(x, y).x - after), 1.5F);
    EXPECT_GT(std::abs(picture(x, y).x - before), 5.0F);
  }
}

}  // namespace
}  // namespace belvedere
