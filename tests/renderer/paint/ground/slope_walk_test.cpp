#include "renderer/paint/ground/slope_walk.h"

#include <gtest/gtest.h>

#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// A walk ends where the class ends, and knows what is there.
TEST(SlopeWalk, EndsWhereItsGroundEnds) {
  GuidanceBuffers g = test::make_slope(120, 120, scree, {0.0F, 0.0F, 1.0F}, 32.0F);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 120; ++x) g.land_cover(x, y) = rock;
  const Grid<float> noise(120, 120, 1.0F);
  const SlopeStart start{{60, 60}, {0.0F, 1.0F}, g.depth_m(60, 60)};
  const SlopeWalk up = walk_slope({g}, noise, start, scree, {2.0F, -1.0F, 26, 5});
  EXPECT_EQ(up.left_after, 11);
  EXPECT_EQ(g.land_cover[up.end], rock);
  EXPECT_EQ(up.noise_sum, 5.0F);
  EXPECT_EQ(walk_slope({g}, noise, start, scree, {2.0F, 1.0F, 6, 3}).left_after, 0) << "six steps stay on it";
}

}  // namespace
}  // namespace belvedere
