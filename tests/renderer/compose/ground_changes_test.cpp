#include "renderer/compose/ground_changes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/renderer/compose/synthetic_region.h"

namespace belvedere {
namespace {

// A valley from north to south between two ranges, its floor falling southwards.
double valley(double e, double n) {
  const double wall = std::min(1500.0, 330.0 * std::abs(e - 30.0));
  return 500.0 + 4.0 * n + wall + 40.0 * std::sin(0.8 * n) * std::min(1.0, wall / 300.0);
}

int floor_cells(const CoarseGround& ground) {
  return static_cast<int>(std::count_if(ground.cells.begin(), ground.cells.end(),
                                        [](const GroundCell& c) { return c.floor; }));
}

TEST(GroundChanges, WiderValleysHaveMoreFloorInTheSameRegion) {
  const CoarseGround ground = make_coarse_ground(test::synthetic_raster(60.0, valley), 300.0);
  const CoarseGround wide = widened_ground(ground, 1500.0);
  EXPECT_GT(floor_cells(wide), floor_cells(ground) + 200) << "of 200 rows";
  EXPECT_EQ(wide.side_m, ground.side_m);
  EXPECT_EQ(wide.relief_m, ground.relief_m);
  EXPECT_EQ(wide.plateau, ground.plateau);
  for (std::size_t i = 0; i < ground.cells.size(); ++i) {
    ASSERT_EQ(wide.cells[i].rim_m, ground.cells[i].rim_m);
    ASSERT_EQ(wide.cells[i].known, ground.cells[i].known);
  }
  // The ridges keep their height, the wall above the old floor has gone.
  const auto rise = [&](double e) {
    return wide.altitude_m(test::position_km(e, 30.0)) -
           ground.altitude_m(test::position_km(e, 30.0));
  };
  EXPECT_NEAR(rise(10.0), 0.0, 10.0);
  EXPECT_LT(rise(30.75), -60.0);
}

TEST(GroundChanges, WhatIsUnknownStaysUnknown) {
  Raster<float> raster = test::synthetic_raster(60.0, valley);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 40; ++x) raster.cells(x, y) = NAN;
  const CoarseGround ground = make_coarse_ground(raster, 300.0);
  const CoarseGround wide = widened_ground(ground, 1000.0);
  for (std::size_t i = 0; i < ground.cells.size(); ++i)
    ASSERT_EQ(wide.cells[i].known, ground.cells[i].known);
}

TEST(GroundChanges, SummitsAreRaisedByThemselves) {
  const CoarseGround ground = test::cone_region();
  const SummitExaggeration by{
      .centre = test::position_km(30.0, 30.0), .radius_m = 5000.0, .factor = 1.3, .base_m = 1200.0};
  const CoarseGround raised = raised_ground(ground, {by});
  const GroundCell& before = *ground.at(by.centre);
  const GroundCell& after = *raised.at(by.centre);
  const double rise = static_cast<double>(after.altitude_m - before.altitude_m);
  EXPECT_NEAR(rise, 0.3 * (static_cast<double>(before.altitude_m) - 1200.0), 5.0)
      << "a cell beside the middle";
  EXPECT_NEAR(static_cast<double>(after.above_m - before.above_m), rise, 1e-3);
  int kept = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x) {
      const glm::dvec2 off = ground.transform.to_crs(x, y) - by.centre;
      if (off.x * off.x + off.y * off.y >= 25e6)
        kept += raised.cells(x, y) == ground.cells(x, y) ? 1 : -1000000;
    }
  EXPECT_GT(kept, 30000) << "beyond the radius all is as it was";
}

}  // namespace
}  // namespace belvedere
