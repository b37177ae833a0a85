#include "renderer/rock/rock_view.h"

#include <gtest/gtest.h>

#include "tests/grids.h"
#include "tests/renderer/rock/rock_wall.h"

namespace belvedere {
namespace {

RockParameters parameters(double pixels_per_unit) {
  RockParameters p;
  p.light.pixels_per_unit = pixels_per_unit;
  p.kind = &find_rock_kind("granite");
  return p;
}

TEST(RockView, LooksAtAPixelAUnit) {
  EXPECT_EQ(thinned_times(1.0, 1), 1);
  EXPECT_EQ(thinned_times(0.4, 1), 1);
  EXPECT_EQ(thinned_times(2.5, 1), 2);
  EXPECT_EQ(thinned_times(8.3, 4), 2);
  const GuidanceBuffers g = test::make_wall(200, 160, 2.0);
  const RockView view = view_rock(g, {g, 1, {0, 0}}, parameters(2.0), {0, 0}, {0, 0, 200, 160});
  EXPECT_EQ(view.far.wide().factor, 2);
  EXPECT_EQ(view.far.whole().width(), 100);
  EXPECT_NEAR(view.far.wide().seen.footprint_m(50, 50), 2.0F * g.footprint_m(100, 100), 1e-4F);
}

// A wall whose distance grows to the right changes from one size of spurs to the next in whole
// cells.
TEST(RockView, SizesChangeByCellsNotByPixels) {
  GuidanceBuffers g = test::make_wall(900, 60, 1.0);
  for (const auto [x, y] : test::cells(900, 60)) {
    g.depth_m(x, y) = 40000.0F + 30.0F * static_cast<float>(x);
    g.footprint_m(x, y) = 15.0F + 0.026F * static_cast<float>(x);
  }
  const RockView view = view_rock(g, {g, 1, {0, 0}}, parameters(1.0), {0, 0}, {0, 0, 900, 60});
  const auto band = [&](int x, int y) {
    return view.bands.at({static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F},
                         g.depth_m(x, y), 2.0F * g.footprint_m(x, y));
  };
  EXPECT_EQ(band(5, 30), 0);
  EXPECT_EQ(band(895, 30), 3);
  int changes = 0;
  for (int x = 1; x < 900; ++x) changes += band(x, 30) != band(x - 1, 30) ? 1 : 0;
  for (const BandCell& cell :
       view.bands.cells) {  // each has the distance of the ground at its seed
    const glm::vec2 at = cell.position;
    if (at.x < 0.0F || at.x >= 900.0F || at.y < 0.0F || at.y >= 60.0F) continue;
    ASSERT_NEAR(cell.depth_m, 40000.0F + 30.0F * at.x, 31.0F);
  }
  EXPECT_GE(changes, 3);
  EXPECT_LE(changes, 9);
}

TEST(RockView, EdgesWaverByLessThanAUnit) {
  const Warp warp(1);
  float max = 0.0F;
  for (int k = 0; k < 2000; ++k) {
    const glm::vec2 position(0.37F * static_cast<float>(k), 0.73F * static_cast<float>(k));
    const glm::vec2 moved = warp(position, 2.0F) - position;
    max = std::max({max, std::abs(moved.x), std::abs(moved.y)});
  }
  EXPECT_GT(max, 0.6F);
  EXPECT_LT(max, 1.7F);
}

}  // namespace
}  // namespace belvedere
