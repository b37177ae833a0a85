#include "renderer/register/drawn_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/filter.h"
#include "terrain/io/raster_io.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr double cell_side_m = 60.0;

// A valley 12 km wide along column 100 that falls to the south.
Dem valley_dem() {
  return make_dem({test::grid_of(201, 300,
                                 [](int x, int y) {
                                   return 1500.0 - 1.2 * y + 0.4 * cell_side_m * std::abs(x - 100);
                                 }),
                   {680000.0, 5260000.0, cell_side_m, cell_side_m},
                   normalize_crs("EPSG:32632")});
}

ControlPair place_at(const Dem& dem, double column, double row) {
  ControlPair place{.position = dem.transform.to_crs(column, row)};
  place.altitude_m = static_cast<double>(sample_bilinear(dem.altitude_m, column, row));
  return place;
}

TEST(DrawnGround, WallsMoveApartWithWhatLiesOnThem) {
  const Dem dem = valley_dem();
  const DrawnGround wide = draw_ground(dem, 300.0, silent_progress());
  for (const double side : {-1.0, 1.0}) {
    const ControlPair wall = place_at(dem, 100.0 + 12.0 * side, 220.0);
    const ControlPair drawn = wide.drawn(wall);
    EXPECT_GT(side * (drawn.position.x - wall.position.x), 75.0);
    EXPECT_LT(side * (drawn.position.x - wall.position.x), 150.0);
    EXPECT_NEAR(drawn.altitude_m, wall.altitude_m, 25.0);
    EXPECT_LT(glm::length(wide.map_position(drawn.position) - wall.position), 2.0);
  }
  const ControlPair ridge = place_at(dem, 4.0, 150.0);
  EXPECT_LT(glm::length(wide.drawn(ridge).position - ridge.position), 5.0);
}

TEST(DrawnGround, WithoutWidthItIsTheMap) {
  const Dem dem = valley_dem();
  const DrawnGround plain = draw_ground(dem, 0.0, silent_progress());
  const ControlPair wall = place_at(dem, 112.0, 220.0);
  EXPECT_EQ(plain.drawn(wall).position, wall.position);
  EXPECT_EQ(plain.drawn(wall).altitude_m, wall.altitude_m);
  EXPECT_EQ(plain.map_position(wall.position), wall.position);
  EXPECT_TRUE(
      std::equal(plain.dem.altitude_m.begin(), plain.dem.altitude_m.end(), dem.altitude_m.begin()));
}

}  // namespace
}  // namespace belvedere
