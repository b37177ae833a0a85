#include "renderer/compose/coarse_ground.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/renderer/compose/synthetic_region.h"

namespace belvedere {
namespace {

TEST(CoarseGround, MeasuresACone) {
  const CoarseGround ground = test::cone_region();
  EXPECT_NEAR(ground.side_m, 60000.0, 1.0);
  EXPECT_EQ(ground.void_share, 0.0);
  EXPECT_NEAR(ground.highest_m, 2500.0, 60.0);
  EXPECT_NEAR(ground.lowest_m, 496.0, 0.2);
  // The top stands 2000 m over a plain that fills the tenth of the side around it but for the
  // cone's own foot.
  const GroundCell* top = ground.at(test::position_km(30.0, 30.0));
  ASSERT_NE(top, nullptr);
  EXPECT_GT(top->above_m, 1000.F);
  EXPECT_LT(top->above_m, 2000.F);
  EXPECT_EQ(top->incision_m, 0.F);
  // Distances to the rim, in the middle and at the edge.
  EXPECT_NEAR(ground.at(test::position_km(30.0, 30.0))->rim_m, 30000.0, 400.0);
  EXPECT_NEAR(ground.at(test::position_km(0.5, 30.0))->rim_m, 450.0, 310.0);
  EXPECT_EQ(ground.at(test::position_km(-0.1, 30.0)), nullptr);
  EXPECT_NEAR(ground.altitude_m(test::position_km(30.0, 33.0)), test::cone(30.0, 33.0), 2.0);
  // Highest less lowest in a window of 3 km either way, 4 km east of the top: from its far corners
  // to its near side, 250 m a km.
  const Grid<float>& relief = ground.local_relief_m(3000.0);
  const auto at =
      ground.transform.to_cell(test::position_km(34.0, 30.0).x, test::position_km(34.0, 30.0).y);
  EXPECT_NEAR(relief(static_cast<int>(at.x), static_cast<int>(at.y)),
              250.0 * (std::hypot(7.0, 3.0) - 1.0), 60.0);
}

TEST(CoarseGround, HolesAreFilledAndTheOutsideIsRim) {
  Raster<float> raster =
      test::synthetic_raster(60.0, [](double e, double n) { return 500.0 + 10.0 * e + n; });
  for (const auto [x, y] : test::cells(30, 200)) raster.cells(x, y) = NAN;  // beyond the data
  for (const auto [x, y] : test::cells({100, 90, 106, 96})) raster.cells(x, y) = NAN;  // a hole
  const CoarseGround ground = make_coarse_ground(raster, 300.0);
  EXPECT_NEAR(ground.void_share, 30.0 / 200.0, 0.002);
  EXPECT_NEAR(ground.side_m, std::sqrt(170.0 * 200.0) * 300.0, 1.0);
  EXPECT_FALSE(ground.cells(10, 50).known);
  EXPECT_EQ(ground.cells(10, 50).rim_m, 0.F);
  EXPECT_TRUE(ground.cells(103, 93).known);
  EXPECT_NEAR(ground.cells(103, 93).altitude_m, 500.0 + 10.0 * 31.0 + 32.0, 12.0);
  EXPECT_NEAR(ground.cells(40, 100).rim_m, 11 * 300.0, 1.0) << "to the first cell without data";
}

TEST(CoarseGround, KnowsPlateausFromMountains) {
  EXPECT_GT(test::canyon_region().plateau, 0.7);
  EXPECT_LT(test::chain_region().plateau, 0.2);
}

TEST(CoarseGround, FindsCanyonsAndWater) {
  const CoarseGround canyon = test::canyon_region();
  const double east = 20.0 + 0.8 * std::sin(0.4 * 15.0);
  EXPECT_NEAR(canyon.at(test::position_km(east, 15.0))->incision_m, 600.0, 130.0);
  EXPECT_LT(canyon.at(test::position_km(8.0, 15.0))->incision_m, 120.0);
  const CoarseGround coast = test::coast_region();
  EXPECT_TRUE(coast.at(test::position_km(25.0, 20.0))->water) << "the bay";
  EXPECT_TRUE(coast.at(test::position_km(40.0, 5.0))->water);
  EXPECT_FALSE(coast.at(test::position_km(40.0, 30.0))->water);
}

TEST(CoarseGround, OfADemIsThatOfItsCells) {
  const Raster<float> fine = test::synthetic_raster(60.0, test::cone, 800);
  const CoarseGround ground =
      coarse_ground_of(coarse_altitudes_of(make_dem(fine), {.max_cells = 200}));
  EXPECT_EQ(ground.cells.width(), 200);
  EXPECT_NEAR(ground.source_cell_m, 75.0, 1e-9);
  const CoarseGround direct = test::cone_region();
  for (const auto& [e, n] : {std::pair{30.0, 35.0}, std::pair{10.0, 10.0}, std::pair{14.0, 38.5}})
    EXPECT_NEAR(ground.altitude_m(test::position_km(e, n)),
                direct.altitude_m(test::position_km(e, n)), 25.0);
}

TEST(CoarseGround, ReadsFilesInCoarseCells) {
  test::Folder folder;
  write_raster(folder / "cone.tif", test::synthetic_raster(60.0, test::cone, 900));
  DemParameters dem;
  dem.sources.push_back({});
  dem.sources.back().path = folder / "cone.tif";
  const CoarseGround ground = read_coarse_ground(dem, silent_progress(), {.max_cells = 300});
  EXPECT_EQ(ground.cells.width(), 300);
  EXPECT_NEAR(ground.cell_m, 200.0, 1e-6);
  EXPECT_NEAR(ground.source_cell_m, 60000.0 / 900.0, 1e-3);
  EXPECT_NEAR(ground.altitude_m(test::position_km(30.0, 33.0)), test::cone(30.0, 33.0), 3.0);
}

// 25 million cells are sampled: the same landscape except for slopes over a few cells.
TEST(CoarseGround, FilesTooLargeToReadAreLookedAt) {
  test::Folder folder;
  const auto slope = [](double e, double n) { return 500.0 + 20.0 * e + 5.0 * n; };
  write_raster(folder / "large.tif", test::synthetic_raster(60.0, slope, 5000));
  DemParameters dem;
  dem.sources.push_back({});
  dem.sources.back().path = folder / "large.tif";
  const CoarseGround ground = read_coarse_ground(dem, silent_progress());
  EXPECT_EQ(ground.cells.width(), 420);
  EXPECT_EQ(ground.void_share, 0.0);
  EXPECT_NEAR(ground.source_cell_m, 12.0, 1e-9);
  for (const auto& [e, n] : {std::pair{30.0, 35.0}, std::pair{1.0, 2.0}, std::pair{59.0, 58.0}})
    EXPECT_NEAR(ground.altitude_m(test::position_km(e, n)), slope(e, n), 2.0);
}

TEST(CoarseGround, NothingKnownIsAnError) {
  EXPECT_THROW(
      make_coarse_ground(test::synthetic_raster(60.0, [](double, double) { return NAN; }), 300.0),
      Error);
}

}  // namespace
}  // namespace belvedere
