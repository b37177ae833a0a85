#include "renderer/paint/ground/slope_walk.h"

#include <gtest/gtest.h>

#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// A walk ends where the class ends, and reports what is there.
TEST(SlopeWalk, EndsWhereItsGroundEnds) {
  GuidanceBuffers g = test::make_slope(120, 120, scree, {0.0F, 0.0F, 1.0F}, 32.0F);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 120; ++x) g.land_cover(x, y) = rock;
  const Grid<float> noise(120, 120, 1.0F);
  const SlopeStart start{{60, 60}, {0.0F, 1.0F}, g.depth_m(60, 60)};
  const SlopeWalk up = walk_slope({g}, noise, start, scree, {2.0F, -1.0F, 26, 5});
  EXPECT_NEAR(up.left_after, 10.25F, 1.0F / 16.0F)
      << "20.5 px up, where the last row of scree ends";
  EXPECT_NEAR(up.end_px.y, -20.5F, 2.0F / 16.0F);
  EXPECT_EQ(g.land_cover[up.end], rock);
  EXPECT_EQ(up.noise_sum, 5.0F);
  EXPECT_EQ(walk_slope({g}, noise, start, scree, {2.0F, 1.0F, 6, 3}).left_after, 0)
      << "six steps stay on it";
}

// A track's edges depend on where it begins: wide pixels must not be visible in them.
TEST(SlopeWalk, NeighboursThatLeaveTheirGroundSideBySideTellPlacesSideBySide) {
  // A wide pixel is 8 of the sheet's and 80 m; ground is as far to the left of the slope's centre
  // as its column gives.
  constexpr int factor = 8;
  GuidanceBuffers g = test::make_slope(40, 40, scree, {0.0F, 0.0F, 1.0F}, 32.0F);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      g.position_m(x, y) = {80.0F * static_cast<float>(x), -80.0F * static_cast<float>(y), 1200.0F};
      if (y < 10) g.land_cover(x, y) = rock;
    }
  const WideView wide{g, factor};
  const Grid<float> noise(40, 40, 1.0F);
  const auto left_at = [&](int x, int y) {
    const SlopeStart start{{x, y}, {0.0F, 1.0F}, g.depth_m(0, 0)};
    const SlopeWalk up = walk_slope(wide, noise, start, scree, {16.0F, -1.0F, 26, 5});
    EXPECT_GT(up.left_after, 0.0F);
    return place_left(wide, start, up);
  };
  for (int x = 100; x < 140; ++x) {
    EXPECT_NEAR(left_at(x + 1, 200).x - left_at(x, 200).x, 10.0F, 0.01F) << x;
    // One below the other, on one line of the slope: one position, to a sixteenth of a step of 16
    // px.
    EXPECT_NEAR(left_at(x, 180 + x).y, left_at(x, 200).y, 10.0F + 0.01F) << x;
  }
}

// At a depth edge the ground behind must not affect the position.
TEST(SlopeWalk, APlaceIsOfItsOwnSurface) {
  GuidanceBuffers g = test::make_slope(40, 40, scree, {0.0F, 0.0F, 1.0F}, 32.0F);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      const bool behind = x >= 20;
      g.depth_m(x, y) = behind ? 60000.0F : 20000.0F;
      g.position_m(x, y) = glm::vec3(behind ? 50000.0F : 100.0F, 0.0F, 1200.0F);
      if (y < 10) g.land_cover(x, y) = rock;
    }
  const WideView wide{g, 8};
  const SlopeStart start{{159, 200}, {0.0F, 1.0F}, 20000.0F};
  const SlopeWalk up =
      walk_slope(wide, Grid<float>(40, 40, 1.0F), start, scree, {16.0F, -1.0F, 26, 5});
  ASSERT_GT(up.left_after, 0.0F);
  EXPECT_EQ(place_left(wide, start, up).x, 100.0F);
}

}  // namespace
}  // namespace belvedere
