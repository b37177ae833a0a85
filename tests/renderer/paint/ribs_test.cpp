#include "renderer/paint/ribs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere {
namespace {

TEST(Ribs, LineIntegralHasDeviationOne) {
  const GuidanceBuffers g = test::make_slope(500, 300, LandCoverClass::rock, {0.0F, 0.3F, 1.0F}, 45.0F);
  const Grid<std::uint8_t> all(500, 300, 1);
  const std::array<Grid<float>, 3> fields = integrate_along_fall_line(g, {g}, all, 3, {0, 0}, 1.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const Grid<float>& field = fields[k];
    double squares = 0.0, along = 0.0, across = 0.0;
    int count = 0;
    for (int y = 60; y < 240; ++y)
      for (int x = 60; x < 440; ++x, ++count) {
        squares += field(x, y) * field(x, y);
        along += field(x, y) * field(x, y + 5);
        across += field(x, y) * field(x + 5, y);
      }
    EXPECT_NEAR(std::sqrt(squares / count), 1.0, 0.2) << "width " << k;
    EXPECT_GT(along, across) << "the field must run down the fall line";
  }
}

TEST(Ribs, DoNotCrossASilhouette) {
  GuidanceBuffers g = test::make_slope(60, 120, LandCoverClass::rock, {0.0F, 0.3F, 1.0F}, 45.0F);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x) g.depth_m(x, y) = 50000.0F;
  const Grid<std::uint8_t> all(60, 120, 1);
  const Grid<float> before = integrate_along_fall_line(g, {g}, all, 3, {0, 0}, 1.0)[0];
  // Turning the far range's fall line must not change the near one.
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x) g.fall_line(x, y) = {0.8F, 0.6F};
  const Grid<float> after = integrate_along_fall_line(g, {g}, all, 3, {0, 0}, 1.0)[0];
  for (int x = 0; x < 60; ++x) EXPECT_EQ(after(x, 61), before(x, 61));
  EXPECT_NE(after(30, 50), before(30, 50));
}

TEST(Ribs, PartWithItsMarginEqualsWhole) {
  const GuidanceBuffers whole = test::make_hills(260, 200, 1.0);
  const Grid<std::uint8_t> all(260, 200, 1);
  const Grid<float> ribs = make_ribs(whole, {whole}, all, {}, {0, 0});
  const int margin = rib_margin_px(1.0);
  const PixelRect part{90, 70, 140, 120};
  const PixelRect wide = test::with_margin(part, margin, 260, 200);
  ASSERT_GT(wide.x0, 0) << "else nothing is cut off";
  const GuidanceBuffers held = test::cut(whole, wide);
  const Grid<float> cut = make_ribs(held, {held, 1, {wide.x0, wide.y0}}, test::cut(all, wide), {}, {wide.x0, wide.y0});
  EXPECT_EQ(test::cut(cut, {part.x0 - wide.x0, part.y0 - wide.y0, part.x1 - wide.x0, part.y1 - wide.y0}), test::cut(ribs, part));
}

// Flanks that are lit from one side lie in shade from the other; the deepest hollows alone, up to a quarter, are dark from both.
TEST(Ribs, TheOtherSunTurnsThemOver) {
  const GuidanceBuffers g = test::make_slope(160, 120, LandCoverClass::rock, {0.0F, 0.3F, 1.0F}, 45.0F);
  const Grid<std::uint8_t> all(160, 120, 1);
  const Grid<float> right = make_ribs(g, {g}, all, {.sun_side = 0.4}, {0, 0});
  const Grid<float> left = make_ribs(g, {g}, all, {.sun_side = -1.0}, {0, 0});
  float strongest = 0.F;
  for (std::size_t i = 0; i < right.size(); ++i) {
    ASSERT_LE(right[i] + left[i], 1e-5F);
    ASSERT_GE(right[i] + left[i], -0.5F - 1e-5F);
    strongest = std::max(strongest, std::abs(right[i]));
  }
  EXPECT_GT(strongest, 0.3F);
}

TEST(Ribs, StandOnlyWhereTheyAreWanted) {
  const GuidanceBuffers g = test::make_slope(80, 60, LandCoverClass::rock, {0.0F, 0.3F, 1.0F}, 45.0F);
  Grid<std::uint8_t> left_half(80, 60, 0);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 40; ++x) left_half(x, y) = 1;
  const Grid<float> some = make_ribs(g, {g}, left_half, {}, {0, 0});
  const Grid<float> everywhere = make_ribs(g, {g}, Grid<std::uint8_t>(80, 60, 1), {}, {0, 0});
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) ASSERT_EQ(some(x, y), x < 40 ? everywhere(x, y) : 0.F) << x << ' ' << y;
}

}  // namespace
}  // namespace belvedere
