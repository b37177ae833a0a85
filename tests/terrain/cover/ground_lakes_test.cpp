#include "terrain/cover/ground_lakes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "tests/grids.h"
#include "tests/terrain/cover/class_rules_ground.h"

namespace belvedere {
namespace {

// Slopes around a round lake of 400 m at 500 m.
Dem hollow() {
  return test::ground(80, [](double e, double n) {
    return 500.0 + std::max(0.0, 0.2 * (std::hypot(e, n) - 400.0));
  });
}
std::size_t count(const Grid<std::uint8_t>& mask) {
  return static_cast<std::size_t>(std::count(mask.begin(), mask.end(), 1));
}

TEST(GroundLakes, LevelGroundWithBanksIsOne) {
  const Grid<std::uint8_t> lakes = ground_lakes(hollow(), {}, {});
  EXPECT_EQ(lakes(40, 40), 1);
  EXPECT_EQ(lakes(2, 40), 0);
  EXPECT_NEAR(static_cast<double>(count(lakes)), 3.14159 * 400.0 * 400.0 / 900.0, 60.0);
}

TEST(GroundLakes, NothingAtSeaIsOne) {
  Sea sea;
  sea.mask = Grid<std::uint8_t>(80, 80, 0);
  for (const auto [x, y] : test::cells(40, 80)) sea.mask(x, y) = 1;
  const Grid<std::uint8_t> lakes = ground_lakes(hollow(), {}, sea);
  EXPECT_EQ(lakes(38, 40), 0);
  EXPECT_EQ(lakes(42, 40), 1);
}

TEST(GroundLakes, HalvedCellsAskForFewerOfThem) {
  Dem dem = hollow();
  LakeParameters large;
  large.min_cells = 1200;  // the lake has some 560
  EXPECT_EQ(count(ground_lakes(dem, large, {})), 0U);
  dem.halved = 1;
  EXPECT_GT(count(ground_lakes(dem, large, {})), 400U);
}

// A void that extends beyond the window's edge is a lake if the surrounding ground has a lake
// there.
TEST(GroundLakes, HolesOverTheRimAreWhatTheWholeKnows) {
  Dem dem = test::ground(80, [](double e, double n) {
    return 500.0 + std::max(0.0, 0.2 * (std::hypot(e + 1200.0, n) - 400.0));
  });
  for (const auto [x, y] : test::cells(80, 80))
    if (dem.altitude_m(x, y) < 500.5F) dem.filled(x, y) = 1;
  LakeParameters none_level;
  none_level.min_cells = 150;
  none_level.min_bank_m = 99.F;  // holes alone
  ASSERT_EQ(count(ground_lakes(dem, none_level, {})), 0U);
  EXPECT_GT(count(ground_lakes(dem, none_level, {}, Grid<std::uint8_t>(80, 80, 1))), 150U);
}

constexpr int side = 400;

TEST(HoleLakes, HaveLevelShores) {
  // A lake in a bowl, and a radar shadow across a slope.
  Raster<float> raster;
  raster.cells = Grid<float>(side, side);
  for (const auto [x, y] : test::cells(side, side)) {
    const double out = std::hypot(x - 100.0, y - 100.0) - 30.0;
    raster.cells(x, y) = out < 0.0 ? NAN : static_cast<float>(500.0 + 0.8 * std::min(out, 200.0));
    if (std::hypot(x - 300.0, y - 300.0) < 20.0) raster.cells(x, y) = NAN;
  }
  for (const auto [x, y] : test::cells({250, 250, 350, 350}))
    if (!std::isnan(raster.cells(x, y)))
      raster.cells(x, y) = 700.F + 5.F * static_cast<float>(x - 250);
  raster.transform = {0.0, 0.0, 30.0, 30.0};
  const Grid<std::uint8_t> lakes = find_hole_lakes(make_dem(std::move(raster)));
  EXPECT_EQ(lakes(100, 100), 1);
  EXPECT_EQ(lakes(300, 300), 0);
  EXPECT_EQ(lakes(140, 100), 0);
}

// A void that extends beyond a window's edge is a lake if the larger terrain has one.
TEST(HoleLakes, OverTheRimAreKnownFromOutside) {
  Dem dem;
  dem.altitude_m = Grid<float>(80, 60, 500.F);
  dem.filled = Grid<std::uint8_t>(80, 60, 0);
  for (const auto [x, y] : test::cells({0, 10, 20, 40})) dem.filled(x, y) = 1;
  EXPECT_EQ(find_hole_lakes(dem)(10, 20), 0);
  Grid<std::uint8_t> known(80, 60, 0);
  EXPECT_EQ(find_hole_lakes(dem, 150, known)(10, 20), 0);
  // Its shore there differs because of the coarser cells.
  for (const auto [x, y] : test::cells({0, 6, 16, 36})) known(x, y) = 1;
  const Grid<std::uint8_t> lakes = find_hole_lakes(dem, 150, known);
  EXPECT_EQ(lakes(10, 20), 1);
  EXPECT_EQ(lakes(19, 39), 1);
  EXPECT_EQ(lakes(10, 8), 0);
}

constexpr int lake_side = 60;

// Noise of ±2 m on level ground at 900 m, a slope that begins in column 40.
Dem shore() {
  Raster<float> raster;
  raster.cells = Grid<float>(lake_side, lake_side);
  raster.transform = {0.0, 10.0 * lake_side, 10.0, 10.0};
  for (const auto [x, y] : test::cells(lake_side, lake_side))
    raster.cells(x, y) = static_cast<float>(900.0 + 2.0 * std::sin(12.9 * x + 78.2 * y) +
                                            (x < 40 ? 0.0 : 10.0 * (x - 39)));
  return make_dem(std::move(raster));
}

KnownLake lake(double x0, double y0, double x1, double y1) {
  return {
      .rings = {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}}, .level_m = {}, .where = "lakes.geojson"};
}

TEST(KnownLakes, WaterIsLevelAtTheGroundsOwnLevel) {
  Dem dem = shore();
  const Dem before = dem;
  KnownLake one = lake(100, 100, 300, 400);
  one.rings.push_back({{150, 200}, {200, 200}, {200, 250}, {150, 250}});  // an island
  const std::vector<LakeLevel> levels = find_lake_levels(dem, {one});
  ASSERT_TRUE(levels[0].level_m.has_value());
  EXPECT_NEAR(*levels[0].level_m, 900.0, 2.0);
  EXPECT_EQ(levels[0].cells, 20U * 30U - 25U);
  EXPECT_EQ(levels[0].bank_share, 0.0);
  level_known_lakes(dem, {one}, levels);
  for (const auto [x, y] : test::cells(lake_side, lake_side)) {
    const glm::dvec2 p = dem.transform.to_crs(x, y);
    const bool water = p.x > 100 && p.x < 300 && p.y > 100 && p.y < 400 &&
                       !(p.x > 150 && p.x < 200 && p.y > 200 && p.y < 250);
    ASSERT_EQ(dem.altitude_m(x, y),
              water ? static_cast<float>(*levels[0].level_m) : before.altitude_m(x, y));
  }
}

TEST(KnownLakes, AnOutlineThatReachesUpTheBankDoesNotLiftTheWater) {
  Dem dem = shore();
  const KnownLake one = lake(100, 100, 550, 400);
  const std::vector<LakeLevel> levels = find_lake_levels(dem, {one});
  EXPECT_NEAR(*levels[0].level_m, 900.0, 2.5);
  EXPECT_NEAR(levels[0].bank_share, 13.0 / 45.0, 0.04);
  level_known_lakes(dem, {one}, levels);
  EXPECT_GT(dem.altitude_m(50, 30), 1000.F) << "a bank stays";
}

// A river bed that is labelled as a lake.
TEST(KnownLakes, GroundThatFallsIsNoLake) {
  Dem dem = shore();
  const Dem before = dem;
  const KnownLake one = lake(420, 100, 590, 400);
  const std::vector<LakeLevel> levels = find_lake_levels(dem, {one});
  EXPECT_TRUE(levels[0].uneven);
  level_known_lakes(dem, {one}, levels);
  EXPECT_EQ(dem.altitude_m, before.altitude_m);
}

TEST(KnownLakes, TheMapsLevelCountsWhereItCanBe) {
  const Dem dem = shore();
  KnownLake one = lake(100, 100, 300, 400);
  one.level_m = 912.0;
  EXPECT_EQ(*find_lake_levels(dem, {one})[0].level_m, 912.0);
  one.level_m = 2960.0;  // in feet
  const LakeLevel odd = find_lake_levels(dem, {one})[0];
  EXPECT_EQ(odd.refused_level_m, 2960.0);
  EXPECT_NEAR(*odd.level_m, 900.0, 2.0);
}

TEST(KnownLakes, TooSmallOrElsewhereChangesNothing) {
  Dem dem = shore();
  const Dem before = dem;
  const std::vector<KnownLake> lakes = {lake(101, 101, 103, 103),
                                        lake(-900, -900, -100, -100),
                                        {.rings = {}, .level_m = {}, .where = ""}};
  const std::vector<LakeLevel> levels = find_lake_levels(dem, lakes);
  for (const LakeLevel& level : levels) EXPECT_FALSE(level.level_m.has_value());
  level_known_lakes(dem, lakes, levels);
  EXPECT_EQ(dem.altitude_m, before.altitude_m);
}

}  // namespace
}  // namespace belvedere
