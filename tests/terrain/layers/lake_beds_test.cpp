#include "terrain/layers/lake_beds.h"

#include <gtest/gtest.h>

#include <cmath>

namespace belvedere {
namespace {

// A round lake of 600 m radius in a bowl, and a pond too small to count.
Dem bowl() {
  Dem dem;
  dem.altitude_m = Grid<float>(200, 200);
  dem.filled = Grid<std::uint8_t>(200, 200, 0);
  dem.transform = {0.0, 0.0, 10.0, 10.0};
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      const double r = 10.0 * std::hypot(x - 100, y - 100);
      dem.altitude_m(x, y) = static_cast<float>(r <= 600.0 ? 500.0 : 500.0 + 0.2 * (r - 600.0));
    }
  return dem;
}

TEST(LakeBeds, AreBowlsDeepestInTheMiddle) {
  const Grid<float> depth = lake_depth_m(bowl());
  EXPECT_EQ(depth(20, 100), 0.F);
  EXPECT_EQ(depth(100, 30), 0.F);
  const float deepest = depth(100, 100);
  EXPECT_NEAR(deepest, 0.08 * 605.0, 2.0);  // half the shore's slope times the way to the shore
  // Half way to the shore: three quarters of the depth; the slope at the shore is .16.
  EXPECT_NEAR(depth(70, 100), 0.75 * deepest, 0.04 * deepest);
  EXPECT_NEAR(depth(43, 100) - depth(42, 100), 1.6, 0.2);
  for (int x = 41; x < 100; ++x) EXPECT_GE(depth(x + 1, 100), depth(x, 100)) << x;
}

TEST(LakeBeds, NoneIsDeeperThanAllowed) {
  LakeBedParameters parameters;
  parameters.deepest_m = 10.0;
  const Grid<float> depth = lake_depth_m(bowl(), parameters);
  EXPECT_NEAR(depth(100, 100), 10.0, 1e-4);
  EXPECT_NEAR(depth(70, 100), 7.5, 0.4);
}

}  // namespace
}  // namespace belvedere
