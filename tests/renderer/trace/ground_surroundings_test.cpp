#include "renderer/trace/ground_surroundings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace belvedere {
namespace {

constexpr double ring_cell_m = 30.0;

template <class Altitude>
Dem dem_of(int width, int height, Altitude&& altitude) {
  Raster<float> raster;
  raster.transform = {650000.0, 5320000.0, ring_cell_m, ring_cell_m};
  raster.cells = Grid<float>(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) raster.cells(x, y) = static_cast<float>(altitude(x, y));
  return make_dem(std::move(raster));
}

LandCover cover_of(const Dem& dem, LandCoverClass id) {
  LandCover cover;
  cover.classes.transform = dem.transform;
  cover.classes.cells = Grid<LandCoverClass>(dem.width(), dem.height(), id);
  return cover;
}

TEST(GroundSurroundings, HeightAboveAValleyIsThatAboveItsFloor) {
  // A trough: 300 m deep, its floor five cells wide, flanks of 10 m per cell.
  const Dem dem = dem_of(81, 60, [](int x, int) {
    return 500.0 + std::clamp(10.0 * (std::abs(x - 40) - 2), 0.0, 300.0);
  });
  const GroundSurroundings found = find_surroundings(dem, cover_of(dem, LandCoverClass::pasture));
  EXPECT_NEAR(found.valley_height_m(40, 30), 0.0, 0.5);
  EXPECT_NEAR(found.valley_height_m(50, 30), 80.0, 0.5);
  EXPECT_NEAR(found.valley_height_m(31, 30), 70.0, 0.5);
}

TEST(GroundSurroundings, TheRimIsTheBorderAndVoidsThatReachIt) {
  Dem dem = dem_of(40, 30, [](int x, int y) { return 500.0 + x + 2.0 * y; });
  const LandCover cover = cover_of(dem, LandCoverClass::pasture);
  const GroundSurroundings whole = find_surroundings(dem, cover);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x)
      EXPECT_NEAR(whole.rim_m(x, y),
                  ring_cell_m * std::min(std::min(x, 39 - x), std::min(y, 29 - y)), 1e-3)
          << x << ' ' << y;
  dem.filled = Grid<std::uint8_t>(40, 30, 0);
  dem.filled(20, 15) = 1;                              // a void inside known terrain
  for (int x = 0; x <= 9; ++x) dem.filled(x, 14) = 1;  // a void that reaches the border
  const GroundSurroundings voids = find_surroundings(dem, cover);
  EXPECT_NEAR(voids.rim_m(20, 15), ring_cell_m * std::hypot(11.0, 1.0), 1e-3);
  EXPECT_EQ(voids.rim_m(9, 14), 0.F);
  EXPECT_NEAR(voids.rim_m(12, 18), ring_cell_m * 5.0, 1e-3);
}

TEST(GroundSurroundings, CatchmentsThatAreThereAreTaken) {
  const Dem dem = dem_of(9, 60, [](int, int y) { return 500.0 - 3.0 * y; });
  const LandCover cover = cover_of(dem, LandCoverClass::settlement);
  Catchments catchments(dem);
  catchments.km2();
  const GroundSurroundings found = find_surroundings(dem, cover, &catchments);
  EXPECT_EQ(found.flow, find_surroundings(dem, cover).flow);
  for (int y = 0; y < 60; ++y)
    EXPECT_NEAR(found.flow(4, y), std::log10(ring_cell_m * ring_cell_m * (y + 1)), 1e-5) << y;
  // Everything is town.
  for (const float built : found.floor_plan.built) EXPECT_NEAR(built, 1.F, 1e-4F);
}

}  // namespace
}  // namespace belvedere
