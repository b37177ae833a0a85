#include "tools/pick/relief_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "terrain/io/crs.h"
#include "tests/grids.h"

namespace belvedere::tools {
namespace {

float brightness(glm::vec3 colour) { return (colour.x + colour.y + colour.z) / 3.F; }

// A ridge from south to north, with low ground west of it at the same altitudes as east of it.
Dem ridge() {
  return make_dem(
      {test::grid_of(60, 40, [](int x, int) { return 2000.0 - 40.0 * std::abs(x - 30); }),
       {0.0, 4000.0, 100.0, 100.0},
       normalize_crs("EPSG:32632")});
}

TEST(ReliefMap, IsLitFromTheWestAndGreenInTheValleys) {
  const ReliefMap map = relief_map(ridge());
  EXPECT_EQ(map.cells_per_px, 1);
  EXPECT_EQ(map.picture.width(), 60);
  EXPECT_GT(brightness(map.picture(20, 20)), brightness(map.picture(40, 20)) + 0.15F);
  const glm::vec3 low = map.picture(2, 20), high = map.picture(28, 20);
  EXPECT_GT(low.y, low.x) << "green";
  EXPECT_LT(std::abs(high.x - high.z), std::abs(low.y - low.z)) << "pale";
}

TEST(ReliefMap, HasNoReliefWithoutDataAndIsReduced) {
  Dem dem = ridge();
  dem.filled = Grid<std::uint8_t>(60, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 10; ++x) dem.filled(x, y) = 1;
  const ReliefMap map = relief_map(dem, 30);
  EXPECT_EQ(map.cells_per_px, 2);
  EXPECT_EQ(map.picture.width(), 30);
  EXPECT_EQ(map.picture.height(), 20);
  EXPECT_EQ(map.picture(0, 0), map.picture(4, 19)) << "grey";
  EXPECT_NE(map.picture(5, 0), map.picture(4, 0));
}

}  // namespace
}  // namespace belvedere::tools
