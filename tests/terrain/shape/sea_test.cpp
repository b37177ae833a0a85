#include "terrain/shape/sea.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>

#include "terrain/shape/mask_pieces.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr int sea_size = 400;
constexpr double sea_cell_m = 30.0;

// A number of -1…1 for a cell.
float noise_at(int x, int y) {
  const std::uint32_t h =
      (static_cast<std::uint32_t>(x) * 2654435761U) ^ (static_cast<std::uint32_t>(y) * 2246822519U);
  const std::uint32_t g = (h ^ (h >> 15U)) * 2654435769U;
  return static_cast<float>((g ^ (g >> 13U)) & 0xffffU) / 32767.5F - 1.F;
}

// Land, m, of a coast: the sea in the west, a beach of 1 %, hills, a cliff in the south, an island;
// < 0 is the sea bed.
float land_at(int x, int y) {
  const double shore = 140.0 + 25.0 * std::sin(y * 0.035) + 12.0 * std::sin(y * 0.11);
  const double inland = (x - shore) * sea_cell_m;
  double z = y > 300 ? (inland > 0.0 ? 60.0 + 0.05 * inland : -30.0)
                     : (inland < 900.0 ? 0.01 * inland : 9.0 + 0.12 * (inland - 900.0));
  const double island = std::hypot(x - 60.0, y - 120.0) * sea_cell_m;
  if (island < 450.0) z = std::max(z, 45.0 - 0.1 * island);
  return static_cast<float>(z);
}

// The coast in a DEM, with the sea at `level` and with that noise.
Dem coast(float level, float roughness) {
  Raster<float> raster;
  raster.cells = Grid<float>(sea_size, sea_size);
  for (const auto [x, y] : test::cells(sea_size, sea_size)) {
    const float land = land_at(x, y);
    raster.cells(x, y) = land < 0.F ? level + roughness * noise_at(x, y)
                                    : level + land + 0.3F * roughness * noise_at(x, y);
  }
  raster.transform = {0.0, 0.0, sea_cell_m, sea_cell_m};
  return make_dem(std::move(raster));
}

// Share of the true sea that is found, and of the land (from `sure_m` up) that is taken for sea.
struct Score {
  double found = 0.0;
  double wrong = 0.0;
};
Score score_of(const Sea& sea, float sure_m) {
  double all = 0.0;
  double land = 0.0;
  Score score;
  for (const auto [x, y] : test::cells(sea_size, sea_size)) {
    const float z = land_at(x, y);
    const bool is_sea = !sea.empty() && sea.mask(x, y) != 0;
    if (z < 0.F) {
      all += 1.0;
      score.found += is_sea ? 1.0 : 0.0;
    } else if (z > sure_m) {
      land += 1.0;
      score.wrong += is_sea ? 1.0 : 0.0;
    }
  }
  return {score.found / all, score.wrong / land};
}

TEST(Sea, OfACalmCoastIsExact) {
  const Sea sea = find_sea(coast(0.F, 0.F));
  ASSERT_FALSE(sea.empty());
  EXPECT_NEAR(sea.level_m, 0.0, 1e-3);
  EXPECT_EQ(sea.noise_m, 0.0);
  const Score score = score_of(sea, 0.31F);
  EXPECT_EQ(score.found, 1.0);
  EXPECT_EQ(score.wrong, 0.0);
}

TEST(Sea, IsFoundUnderTwoMetresOfNoise) {
  for (const float level : {0.F, 0.6F, -0.9F}) {
    const Sea sea = find_sea(coast(level, 2.F));
    ASSERT_FALSE(sea.empty()) << level;
    EXPECT_NEAR(sea.level_m, level, 0.1);
    EXPECT_NEAR(sea.noise_m, 1.9, 0.15);
    const Score score = score_of(sea, 3.F);
    EXPECT_GT(score.found, 0.995) << level;
    EXPECT_LT(score.wrong, 1e-4) << level;
  }
}

TEST(Sea, IslandsAndCliffsStayLand) {
  for (const float roughness : {0.F, 2.F}) {
    const Sea sea = find_sea(coast(0.F, roughness));
    ASSERT_FALSE(sea.empty());
    EXPECT_EQ(sea.mask(60, 120), 0);
    EXPECT_EQ(sea.mask(60, 126), 0);
    EXPECT_EQ(sea.mask(60, 140), 1);
    EXPECT_EQ(sea.mask(10, 350), 1);
    EXPECT_EQ(sea.mask(200, 350), 0);
  }
}

// A polder behind a dike, and a basin far below the sea that reaches the edge of the data.
TEST(Sea, LandBelowItIsLand) {
  for (const float roughness : {0.F, 2.F}) {
    Dem dem = coast(0.F, roughness);
    for (const auto [x, y] : test::cells({190, 40, 260, 110}))
      dem.altitude_m(x, y) =
          x < 193 || y < 43 || x > 256 || y > 106 ? 6.F : -2.5F + 0.3F * roughness * noise_at(x, y);
    for (const auto [x, y] : test::cells({330, 150, sea_size, 250})) dem.altitude_m(x, y) = -80.F;
    const Sea sea = find_sea(dem);
    ASSERT_FALSE(sea.empty());
    EXPECT_NEAR(sea.level_m, 0.0, 0.1);
    for (const auto [x, y] : test::cells({195, 45, 255, 105})) ASSERT_EQ(sea.mask(x, y), 0);
    EXPECT_EQ(sea.mask(380, 200), 0);
    EXPECT_GT(score_of(sea, 3.F).found, 0.995);
  }
}

// Flats that dry at low tide: below the level they are sea, above it land, and channels in them are
// sea.
TEST(Sea, TidalFlatsEndAtItsLevel) {
  Dem dem = coast(0.F, 0.F);
  for (const auto [x, y] : test::cells({90, 20, 190, 80}))
    dem.altitude_m(x, y) = -0.8F + 0.02F * static_cast<float>(x - 90);
  const Sea sea = find_sea(dem);
  ASSERT_FALSE(sea.empty());
  EXPECT_EQ(sea.mask(100, 50), 1);
  EXPECT_EQ(sea.mask(130, 50), 1);
  EXPECT_EQ(sea.mask(160, 50), 0);
}

TEST(Sea, PlainsThatRiseGentlyAreNone) {
  // 1 in 2000 from -3 m up to the edge, and the same with noise.
  for (const float roughness : {0.F, 0.5F}) {
    Raster<float> raster;
    raster.cells = Grid<float>(sea_size, sea_size);
    for (const auto [x, y] : test::cells(sea_size, sea_size))
      raster.cells(x, y) = -3.F + 0.015F * static_cast<float>(x) + roughness * noise_at(x, y);
    raster.transform = {0.0, 0.0, sea_cell_m, sea_cell_m};
    EXPECT_TRUE(find_sea(make_dem(std::move(raster))).empty()) << roughness;
  }
}

TEST(Sea, LakesByTheSeaAreNone) {
  // A lagoon at the sea's level that touches neither.
  Dem dem = coast(0.F, 0.F);
  for (const auto [x, y] : test::cells(sea_size, sea_size))
    if (std::hypot(x - 300.0, y - 150.0) < 30.0) dem.altitude_m(x, y) = 0.F;
  const Sea sea = find_sea(dem);
  EXPECT_EQ(sea.mask(300, 150), 0);
  EXPECT_EQ(sea.mask(10, 150), 1);
}

TEST(Sea, RoughBaysBehindASpitAreSea) {
  for (const int farther : {0, 100}) {
    Dem dem = coast(0.F, 2.F);
    for (const auto [x, y] : test::cells(sea_size, sea_size))
      if (std::hypot(x - 190.0 - farther, y - 100.0) < 50.0)
        dem.altitude_m(x, y) = 2.F * noise_at(x, y);
    EXPECT_EQ(find_sea(dem).mask(190 + farther, 100), farther == 0 ? 1 : 0);
  }
}

TEST(Sea, HolesBesideItAreSea) {
  // All of the sea west of column 60 is void, or all of it.
  for (const int known_from : {60, 1000}) {
    Raster<float> raster;
    raster.cells = Grid<float>(sea_size, sea_size);
    for (const auto [x, y] : test::cells(sea_size, sea_size)) {
      const float land = land_at(x, y);
      raster.cells(x, y) = land >= 0.F ? land : x < known_from ? NAN : 0.F;
    }
    // A void on a mountain at the border is not sea.
    for (const auto [x, y] : test::cells({380, 180, sea_size, 220})) raster.cells(x, y) = NAN;
    raster.transform = {0.0, 0.0, sea_cell_m, sea_cell_m};
    Dem dem = make_dem(std::move(raster));
    const Sea sea = find_sea(dem);
    ASSERT_FALSE(sea.empty()) << known_from;
    EXPECT_EQ(score_of(sea, 0.31F).found, 1.0) << known_from;
    EXPECT_LT(score_of(sea, 2.5F).wrong, 1e-4) << known_from;
    EXPECT_EQ(sea.mask(390, 200), 0);
    level_sea(dem, sea);
    EXPECT_EQ(dem.altitude_m(20, 20), static_cast<float>(sea.level_m));
    EXPECT_EQ(dem.filled(20, 20), 0);
    EXPECT_EQ(dem.filled(390, 200), 1);
  }
}

TEST(Sea, StaysWhereItIsOnceLevel) {
  Dem dem = coast(0.3F, 2.F);
  const Sea sea = find_sea(dem);
  level_sea(dem, sea);
  const Sea again = find_sea(dem);
  ASSERT_FALSE(again.empty());
  EXPECT_NEAR(again.level_m, sea.level_m, 1e-3);
  std::size_t lost = 0;
  for (std::size_t i = 0; i < sea.mask.size(); ++i)
    lost += sea.mask[i] != 0 && again.mask[i] == 0 ? 1 : 0;
  EXPECT_EQ(lost, 0U);
}

TEST(Sea, StandsWhereTheSceneSays) {
  // The bed is known: nothing is level.
  Raster<float> raster;
  raster.cells = Grid<float>(sea_size, sea_size);
  for (const auto [x, y] : test::cells(sea_size, sea_size))
    raster.cells(x, y) = 0.2F * static_cast<float>(x - 100);
  raster.transform = {0.0, 0.0, sea_cell_m, sea_cell_m};
  const Dem dem = make_dem(std::move(raster));
  EXPECT_TRUE(find_sea(dem).empty());
  const Sea sea = find_sea(dem, {.level_m = 4.0});
  EXPECT_EQ(sea.mask(119, 7), 1);
  EXPECT_EQ(sea.mask(123, 7), 0);
  EXPECT_DOUBLE_EQ(sea.level_m, 4.0);
  EXPECT_NEAR(sea.share, 122.0 / sea_size, 1e-9);
  EXPECT_TRUE(find_sea(coast(0.F, 0.F), {.look = false}).empty());
}

TEST(Sea, MountainsHaveNone) {
  Dem dem = coast(600.F, 0.F);
  EXPECT_TRUE(find_sea(dem).empty());
}

TEST(DistanceToSea, IsMetresFromItsCells) {
  Grid<std::uint8_t> sea(10, 4, 0);
  EXPECT_EQ(distance_to_marked_m(sea, 30.0)(3, 3), 1e6F);
  sea(0, 0) = 1;
  const Grid<float> distance = distance_to_marked_m(sea, 30.0);
  EXPECT_EQ(distance(0, 0), 0.F);
  EXPECT_FLOAT_EQ(distance(3, 0), 90.F);
  EXPECT_FLOAT_EQ(distance(4, 3), 150.F);
}

// A part of a DEM, as a window of the same cells.
Dem part(const Dem& dem, int x0, int y0, int width, int height) {
  Dem out;
  out.altitude_m = Grid<float>(width, height);
  out.filled = Grid<std::uint8_t>(width, height);
  for (const auto [x, y] : test::cells(width, height)) {
    out.altitude_m(x, y) = dem.altitude_m(x0 + x, y0 + y);
    out.filled(x, y) = dem.filled(x0 + x, y0 + y);
  }
  out.transform = {dem.transform.origin_x + x0 * sea_cell_m,
                   dem.transform.origin_y - y0 * sea_cell_m, sea_cell_m, sea_cell_m};
  return out;
}

// Means of four by four cells.
Dem coarse(const Dem& dem) {
  Raster<float> raster{
      Grid<float>(sea_size / 4, sea_size / 4),
      {dem.transform.origin_x, dem.transform.origin_y, 4 * sea_cell_m, 4 * sea_cell_m},
      {}};
  for (const auto [x, y] : test::cells(sea_size / 4, sea_size / 4)) {
    float sum = 0.F;
    for (const auto [i, j] : test::cells(4, 4)) sum += dem.altitude_m(4 * x + i, 4 * y + j) / 16.F;
    raster.cells(x, y) = sum;
  }
  return make_dem(std::move(raster));
}

TEST(SeaOfAWindow, IsThatOfTheWholeAtItsLevel) {
  for (const float roughness : {0.F, 1.F}) {
    const Dem dem = coast(0.4F, roughness);
    const Dem whole = coarse(dem);
    // Steps of the whole's cells; a sea of 35 of them is too narrow to be distinguished from noise
    // there.
    Sea of_whole = find_sea(dem);
    const Grid<std::uint8_t> fine =
        std::exchange(of_whole.mask, Grid<std::uint8_t>(sea_size / 4, sea_size / 4));
    for (const auto [x, y] : test::cells(sea_size / 4, sea_size / 4))
      of_whole.mask(x, y) = fine(4 * x + 1, 4 * y + 2);
    const Dem window = part(dem, 60, 40, 220, 240);
    const Sea sea = continue_sea(window, whole, of_whole);
    ASSERT_FALSE(sea.empty()) << roughness;
    EXPECT_EQ(sea.level_m, of_whole.level_m);
    int wet = 0;
    int found = 0;
    int wrong = 0;
    for (const auto [x, y] : test::cells(220, 240)) {
      const float land = land_at(60 + x, 40 + y);
      wet += land < 0.F ? 1 : 0;
      found += land < 0.F && sea.mask(x, y) != 0 ? 1 : 0;
      wrong += land > 1.F + 2.F * roughness && sea.mask(x, y) != 0 ? 1 : 0;
    }
    EXPECT_GT(found, 0.99 * wet) << roughness;
    EXPECT_LT(wrong, 0.005 * wet) << roughness
                                  << ": its shore is the window's, not the whole's steps";
    EXPECT_EQ(find_sea(window, {.known = std::make_shared<const Sea>(sea)}).mask, sea.mask)
        << "nothing else is looked for";
  }
}

TEST(SeaOfAWindow, LevelGroundAtItsRimIsNone) {
  // A basin at 0 m inland, cut by the window's border: alone the window takes it for sea.
  Dem dem = coast(0.F, 0.F);
  for (const auto [x, y] : test::cells({250, 60, 390, 180})) dem.altitude_m(x, y) = 0.F;
  const Dem whole = coarse(dem);
  const Sea of_whole = find_sea(whole, {.min_cells = 100});
  ASSERT_FALSE(of_whole.empty());
  EXPECT_EQ(of_whole.mask(320 / 4, 120 / 4), 0);
  const Dem window = part(dem, 230, 40, 100, 160);
  ASSERT_FALSE(find_sea(window).empty());
  EXPECT_TRUE(continue_sea(window, whole, of_whole).empty());
  EXPECT_TRUE(continue_sea(part(dem, 0, 0, 300, 300), whole, {}).empty())
      << "nor is there any where the whole has none";
  const Dem both = part(dem, 60, 40, 270, 160);
  const Sea sea = continue_sea(both, whole, of_whole);
  ASSERT_FALSE(sea.empty());
  EXPECT_EQ(sea.mask(320 - 60, 120 - 40), 0);
  EXPECT_EQ(sea.mask(10, 10), 1);
}

}  // namespace
}  // namespace belvedere
