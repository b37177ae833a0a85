#include "texture/composite/composite_figures.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace belvedere {
namespace {

// Light above a height, dark below.
Grid<Rgb8> halves(int width, int height, bool turned) {
  Grid<Rgb8> out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto grain = static_cast<std::uint8_t>(random_index(8, 1, x, y));
      const auto v = static_cast<std::uint8_t>(((y < height / 2) != turned ? 200 : 40) + grain);
      out(x, y) = {v, v, static_cast<std::uint8_t>(v / 2)};
    }
  return out;
}

TEST(LayoutFigures, KnowTopFromBottomAtAnySize) {
  const Grid<Rgb8> crop = halves(160, 160, false);
  const LayoutFigures same = layout_figures(crop, crop);
  EXPECT_EQ(same.profile, 0.0);
  EXPECT_EQ(same.far_pairs, 0.0);
  EXPECT_LT(layout_figures(crop, halves(200, 320, false)).profile, .02);
  // Turned over, every strip contains what it never contained; differences along rows stay, those
  // along columns change their sign.
  const LayoutFigures turned = layout_figures(crop, halves(160, 160, true));
  EXPECT_NEAR(turned.profile, 2.0, 1e-9);
  // In one band of three, along columns: of pairs d apart the share d / (160 - d), at most 1,
  // crosses the centre, and all of these change.
  EXPECT_NEAR(turned.far_pairs, 2.0 / 24.0 * (16.0 / 144.0 + 32.0 / 128.0 + 64.0 / 96.0 + 1.0),
              .01);
}

// The brightest colour is in no strip's share of another one's.
TEST(LayoutFigures, OfOtherColoursHaveNothingInCommon) {
  Grid<Rgb8> white(160, 160);
  Grid<Rgb8> blue(160, 160);
  for (int y = 0; y < 160; ++y)
    for (int x = 0; x < 160; ++x) {
      const auto grain = static_cast<std::uint8_t>(random_index(8, 1, x, y));
      white(x, y).fill(static_cast<std::uint8_t>(248 + grain));
      blue(x, y) = {grain, grain, static_cast<std::uint8_t>(192 + grain)};
    }
  EXPECT_NEAR(layout_figures(white, blue).profile, 2.0, 1e-9);
}

}  // namespace
}  // namespace belvedere
