#include "terrain/shape/known_lakes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace belvedere {
namespace {

constexpr int lake_side = 60;

// Noise of ±2 m on level ground at 900 m, a slope that begins in column 40.
Dem shore() {
  Raster<float> raster;
  raster.cells = Grid<float>(lake_side, lake_side);
  raster.transform = {0.0, 10.0 * lake_side, 10.0, 10.0};
  for (int y = 0; y < lake_side; ++y)
    for (int x = 0; x < lake_side; ++x)
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
  for (int y = 0; y < lake_side; ++y)
    for (int x = 0; x < lake_side; ++x) {
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
