#include "renderer/paint/rock_planes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere {
namespace {

TEST(RockPlanes, AreFlatWithSharpEdgesAndOfBothKinds) {
  const GuidanceBuffers g = test::make_slope(400, 300, LandCoverClass::rock, {0.3F, 0.3F, 1.0F}, 45.0F);
  const Grid<float> planes = make_rock_planes(g, Grid<std::uint8_t>(400, 300, 1), {}, {0, 0});
  int same = 0;
  int light = 0;
  int dark = 0;
  for (int y = 0; y < 300; ++y)
    for (int x = 1; x < 400; ++x) {
      same += planes(x, y) == planes(x - 1, y) ? 1 : 0;
      light += planes(x, y) > 0.2F ? 1 : 0;
      dark += planes(x, y) < -0.2F ? 1 : 0;
    }
  EXPECT_GT(same, 399 * 300 * 8 / 10);  // runs of ten pixels and more
  EXPECT_GT(light, 399 * 300 / 5);
  EXPECT_GT(dark, 399 * 300 / 5);
  EXPECT_NEAR(test::mean(planes), 0.0, 0.12);
}

TEST(RockPlanes, StayInPlaceAndGrowWithTheSheet) {
  const GuidanceBuffers g = test::make_slope(200, 150, LandCoverClass::rock, {0.3F, 0.3F, 1.0F}, 45.0F);
  const Grid<std::uint8_t> all(200, 150, 1);
  const Grid<float> whole = make_rock_planes(g, all, {}, {0, 0});
  EXPECT_EQ(make_rock_planes(g, all, {}, {50, 20})(10, 10), whole(60, 30));
  PlaneParameters twice;
  twice.pixels_per_unit = 2.0;
  const Grid<float> large = make_rock_planes(g, all, twice, {0, 0});
  int same = 0;
  for (int y = 0; y < 75; ++y)
    for (int x = 0; x < 100; ++x) same += std::abs(large(2 * x, 2 * y) - whole(x, y)) < 1e-6F ? 1 : 0;
  EXPECT_GT(same, 7500 * 9 / 10);
}

TEST(RockPlanes, TurnWithTheSunsSide) {
  const GuidanceBuffers g = test::make_slope(60, 40, LandCoverClass::rock, {0.3F, 0.3F, 1.0F}, 45.0F);
  const Grid<std::uint8_t> all(60, 40, 1);
  PlaneParameters left;
  left.sun_side = -1.0;
  EXPECT_EQ(make_rock_planes(g, all, left, {0, 0})(30, 20), -make_rock_planes(g, all, {}, {0, 0})(30, 20));
}

}  // namespace
}  // namespace belvedere
