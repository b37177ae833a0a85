#include "terrain/layers/fit/hue_saturation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace belvedere {
namespace {

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
