#include "terrain/shape/hole_lakes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace belvedere {
namespace {

constexpr int side = 400;

TEST(HoleLakes, HaveLevelShores) {
  // A lake in a bowl, and a radar shadow across a slope.
  Raster<float> raster;
  raster.cells = Grid<float>(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double out = std::hypot(x - 100.0, y - 100.0) - 30.0;
      raster.cells(x, y) = out < 0.0 ? NAN : static_cast<float>(500.0 + 0.8 * std::min(out, 200.0));
      if (std::hypot(x - 300.0, y - 300.0) < 20.0) raster.cells(x, y) = NAN;
    }
  for (int y = 250; y < 350; ++y)
    for (int x = 250; x < 350; ++x)
      if (!std::isnan(raster.cells(x, y)))
        raster.cells(x, y) = 700.F + 5.F * static_cast<float>(x - 250);
  raster.transform = {0.0, 0.0, 30.0, 30.0};
  const Dem dem = make_dem(std::move(raster));
  const Grid<std::uint8_t> lakes = find_hole_lakes(dem);
  EXPECT_EQ(lakes(100, 100), 1);
  EXPECT_EQ(lakes(300, 300), 0);
  EXPECT_EQ(lakes(140, 100), 0);
}

// A void that extends beyond a window's edge is a lake if the larger terrain has one.
TEST(HoleLakes, OverTheRimAreKnownFromOutside) {
  Dem dem;
  dem.altitude_m = Grid<float>(80, 60, 500.F);
  dem.filled = Grid<std::uint8_t>(80, 60, 0);
  for (int y = 10; y < 40; ++y)
    for (int x = 0; x < 20; ++x) dem.filled(x, y) = 1;
  EXPECT_EQ(find_hole_lakes(dem)(10, 20), 0);
  Grid<std::uint8_t> known(80, 60, 0);
  EXPECT_EQ(find_hole_lakes(dem, 150, known)(10, 20), 0);
  // Its shore there differs because of the coarser cells.
  for (int y = 6; y < 36; ++y)
    for (int x = 0; x < 16; ++x) known(x, y) = 1;
  const Grid<std::uint8_t> lakes = find_hole_lakes(dem, 150, known);
  EXPECT_EQ(lakes(10, 20), 1);
  EXPECT_EQ(lakes(19, 39), 1);
  EXPECT_EQ(lakes(10, 8), 0);
}

}  // namespace
}  // namespace belvedere
