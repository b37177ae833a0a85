#include "renderer/paint/ground/slope_walk.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/grids.h"
#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// A walk ends where the class ends, and reports what is there.
TEST(SlopeWalk, EndsWhereItsGroundEnds) {
  GuidanceBuffers g = test::make_slope(120, 120, scree, {0.0F, 0.0F, 1.0F}, 32.0F);
  for (const auto [x, y] : test::cells(120, 40)) g.land_cover(x, y) = rock;
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
  for (const auto [x, y] : test::cells(40, 40)) {
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
  for (const auto [x, y] : test::cells(40, 40)) {
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

using enum LandCoverClass;

// Rock above row 40, grass from row 80 on, scree between; the slope falls straight down.
GuidanceBuffers fan(int width = 120, int height = 120) {
  GuidanceBuffers g = test::make_slope(width, height, scree, {0.0F, 0.0F, 1.0F}, 32.0F);
  for (const auto [x, y] : test::cells(width, height))
    if (y < 40 || y >= 80) g.land_cover(x, y) = y < 40 ? rock : alpine_grass;
  return g;
}

TEST(ScreeFans, KnowTheirPlaceBetweenWallAndFoot) {
  const GuidanceBuffers g = fan();
  const ScreeFans fans = make_scree_fans(g, {g}, {}, {0, 0});
  EXPECT_LT(fans.position(60, 41), 0.1F);
  EXPECT_NEAR(fans.position(60, 60), 0.5F, 0.06F);
  EXPECT_GT(fans.position(60, 78), 0.9F);
  EXPECT_EQ(fans.position(60, 20), 0.0F) << "no scree";
  for (int y = 41; y < 79; ++y)
    EXPECT_GE(fans.position(60, y), fans.position(60, y - 1) - 1e-6F) << y;
}

TEST(ScreeFans, StreaksRunDownTheSlopeAndHaveDeviationOne) {
  GuidanceBuffers g = test::make_slope(400, 300, scree, {0.0F, 0.0F, 1.0F}, 32.0F);
  const ScreeFans fans = make_scree_fans(g, {g}, {}, {0, 0});
  double down = 0.0;
  double across = 0.0;
  double squares = 0.0;
  int count = 0;
  for (const auto [x, y] : test::cells({20, 60, 380, 230})) {
    down += std::abs(fans.streak(x, y + 5) - fans.streak(x, y));
    across += std::abs(fans.streak(x + 5, y) - fans.streak(x, y));
    squares += static_cast<double>(fans.streak(x, y)) * static_cast<double>(fans.streak(x, y));
    ++count;
  }
  EXPECT_LT(down, 0.5 * across);
  EXPECT_NEAR(std::sqrt(squares / count), 1.0, 0.15);
}

TEST(ScreeFans, AreGreyAtTheWallAndGrownOverAtTheFoot) {
  const ScreeTurn wall = scree_turn(0.0F, 0.0F, 0.0F, 1.0F);
  const ScreeTurn centre = scree_turn(0.6F, 0.0F, 0.0F, 1.0F);
  const ScreeTurn foot = scree_turn(1.0F, 0.0F, 0.0F, 1.0F);
  EXPECT_GT(wall.factor.b - wall.factor.r, 0.1F);
  EXPECT_LT(centre.factor.b, centre.factor.r);
  EXPECT_GT(centre.tone, wall.tone + 0.05F);
  EXPECT_EQ(wall.grown, 0.0F);
  EXPECT_EQ(centre.grown, 0.0F);
  EXPECT_NEAR(foot.grown, 0.75F, 1e-6F);
  const ScreeTurn off = scree_turn(1.0F, 1.0F, 8.0F, 0.0F);
  EXPECT_EQ(off.tone, 0.0F);
  EXPECT_EQ(off.factor, glm::vec3(1.0F));
  EXPECT_EQ(off.grown, 0.0F);
}

TEST(ScreeFans, NearConesAreFresherThanWhatLiesBetween) {
  EXPECT_EQ(near_scree_hue(true, 0.0F), glm::vec3(1.0F));
  EXPECT_EQ(near_scree_hue(false, 0.0F), glm::vec3(1.0F));
  for (int k = 0; k < 3; ++k)
    EXPECT_GT(near_scree_hue(true, 1.0F)[k], near_scree_hue(false, 1.0F)[k] + 0.04F);
}

TEST(ScreeFans, PartEqualsWhole) {
  GuidanceBuffers g = fan(300, 120);
  for (auto& d : g.fall_line) d = glm::vec2(0.28F, 0.96F);
  const ScreeFans whole = make_scree_fans(g, {g}, {}, {0, 0});
  const PixelRect kept{110, 50, 190, 78};
  const PixelRect part = test::with_margin(kept, scree_fans_margin_px(1.0), 300, 120);
  ASSERT_GT(part.x0, 0);
  const GuidanceBuffers held = test::cut(g, part);
  const ScreeFans fans =
      make_scree_fans(held, {held, 1, {part.x0, part.y0}}, {}, {part.x0, part.y0});
  for (const auto [x, y] : test::cells(kept)) {
    ASSERT_EQ(fans.position(x - part.x0, y - part.y0), whole.position(x, y));
    ASSERT_EQ(fans.streak(x - part.x0, y - part.y0), whole.streak(x, y));
  }
}

}  // namespace
}  // namespace belvedere
