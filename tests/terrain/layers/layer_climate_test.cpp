#include "terrain/layers/layer_climate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/error.h"
#include "base/grid.h"
#include "base/parallel.h"
#include "terrain/climate/map_climate.h"
#include "terrain/climate/radiation.h"
#include "terrain/cover/class_rules.h"
#include "terrain/io/raster_io.h"
#include "terrain/layers/layer_coverage.h"
#include "terrain/layers/layers_file.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

// A tent: a ridge from west to east, 30° steep on both sides, 90 cells of 20 m in each direction,
// in Tyrol.
constexpr int width = 60;
constexpr int height = 181;
Dem tent(const std::string& crs = "EPSG:32632") {
  Raster<float> raster{Grid<float>(width, height),
                       {680000.0, 5240000.0, 20.0, 20.0},
                       crs.empty() ? crs : normalize_crs(crs)};
  for (const auto [x, y] : test::cells(width, height))
    raster.cells(x, y) =
        2500.F - static_cast<float>(20.0 * std::abs(y - 90) * std::numbers::inv_sqrt3);
  return make_dem(std::move(raster));
}

// Uniform: months with means of -2 … 9 °C at sea level, 6 K/km; 700 mm at the bottom, 100 mm more
// every km.
Climate even_climate(const Dem& dem) {
  PlaceClimate column;
  for (std::size_t m = 0; m < 12; ++m) {
    column.sea_level_c[m] = static_cast<double>(m) - 2.0;
    column.lapse_k_per_km[m] = 6.0;
  }
  for (std::size_t km = 0; km < 8; ++km)
    column.rain_mm_at_km[km] = 700.0 + 100.0 * static_cast<double>(km);
  Climate climate;
  climate.position = make_map_position(dem.transform, dem.crs, dem.width(), dem.height(), {});
  climate.nodes = Grid<PlaceClimate>(2, 2, column);
  climate.sources = {"synthetic"};
  return climate;
}

const ClimateMaker nobody = []() -> Climate {
  ADD_FAILURE() << "the climate is not needed";
  return {};
};

TEST(LayerClimate, TemperatureAndRainAreTheYearsAtEachCellsAltitude) {
  const Dem dem = tent();
  int asked = 0;
  const LayerClimateGrids grids = make_layer_climate(
      dem, {"temperature", "altitude", "rain"}, {}, {},
      [&] {
        ++asked;
        return even_climate(dem);
      },
      silent_progress());
  EXPECT_EQ(asked, 1);
  EXPECT_THAT(grids.sources, testing::ElementsAre("synthetic"));
  for (int y = 0; y < height; y += 9)
    for (int x = 0; x < width; x += 7) {
      const auto km = static_cast<double>(dem.altitude_m(x, y)) / 1000.0;
      ASSERT_NEAR(static_cast<double>(grids.temperature_c(x, y)), 3.5 - 6.0 * km, 2e-5);
      ASSERT_NEAR(static_cast<double>(grids.rain_mm(x, y)), 700.0 + 100.0 * km, 1e-3);
    }
  // Inputs that were not requested are absent.
  EXPECT_TRUE(grids.radiation.empty());
  EXPECT_TRUE(grids.sky_view.empty());
  EXPECT_EQ(grids.view().radiation, nullptr);
}

// On each side of a long straight tent the whole year's sun above the plane and above the horizon:
// summed here without tables.
TEST(LayerClimate, RadiationIsThatOfTheGroundInAYear) {
  const Dem dem = tent();
  const LayerClimateGrids grids =
      make_layer_climate(dem, {"radiation", "sky_view"}, {}, {}, nobody, silent_progress());
  EXPECT_TRUE(grids.temperature_c.empty());
  const MapPosition position =
      make_map_position(dem.transform, dem.crs, dem.width(), dem.height(), {});
  const auto expected = [&](int row) {
    const double north_deg = position.grid_north_deg.at(30, row);
    const double sine = row < 90 ? 0.5 : -0.5;  // of the slope towards north: rows run south
    double sum = 0.0;
    for (const SunMoment& sun : sun_moments(position.latitude_deg.at(30, row), {})) {
      const double towards_north =
          sun.cosine * std::cos(sun.azimuth_rad - north_deg * std::numbers::pi / 180.0);
      const double on_plane = 0.5 * std::numbers::sqrt3 * sun.sine + sine * towards_north;
      if (on_plane > 0.0)
        sum += sun.exposure_mj *
               clear_share(0.75, sun.air_mass, static_cast<double>(dem.altitude_m(30, row))) *
               on_plane;
    }
    return sum;
  };
  // Away from the crest, which the blur rounds, and from the rims. The ridge is 60 cells long,
  // which lets sun around its ends.
  EXPECT_NEAR(static_cast<double>(grids.radiation(30, 130)), expected(130), 0.02 * expected(130));
  EXPECT_NEAR(static_cast<double>(grids.radiation(30, 50)), expected(50), 0.06 * expected(50));
  EXPECT_GT(grids.radiation(30, 130), 2.F * grids.radiation(30, 50));
  // The mean of cos² of a plane's own horizon: 1/(1 + tan²30° cos²φ) uphill, 1 downhill, which is
  // (1 + cos 30°) / 2.
  EXPECT_NEAR(static_cast<double>(grids.sky_view(30, 130)), 0.9330, 0.003);
  EXPECT_NEAR(static_cast<double>(grids.sky_view(30, 50)), 0.9330, 0.003);
}

// Ground by the sea with a lake: the same variables as in rules, cell by cell.
TEST(LayerClimate, TreelineLakeAndSeaAreTheRules) {
  Raster<float> raster{
      Grid<float>(200, 160), {680000.0, 5240000.0, 60.0, 60.0}, normalize_crs("EPSG:32632")};
  for (const auto [x, y] : test::cells(200, 160)) {
    const double hill = std::max(0.0, 0.25 * 60.0 * (x - 60));
    const double lake = 450.0 + std::max(0.0, 0.2 * (60.0 * std::hypot(x - 130, y - 80) - 900.0));
    raster.cells(x, y) = static_cast<float>(x < 60                               ? 0.0
                                            : std::hypot(x - 130, y - 80) < 30.0 ? lake
                                                                                 : hill);
  }
  const Dem dem = make_dem(std::move(raster));
  Climate climate = even_climate(dem);
  for (std::size_t m = 0; m < 12; ++m)
    for (int x = 0; x < 2; ++x)
      for (int y = 0; y < 2; ++y)
        climate.nodes(x, y).sea_level_c[m] += 8.0 + 3.0 * x;  // the line rises eastwards
  const LayerClimateGrids grids = make_layer_climate(
      dem, {"treeline", "lake", "sea"}, {}, {}, [&] { return climate; }, silent_progress());
  ClassRuleParameters parameters;
  parameters.climate = make_map_climate(dem, climate, {});
  const ClassRules rules{"one",
                         {{"speck_cells", 0.0}},
                         {},
                         {{LandCoverClass::rock, "1"},
                          {LandCoverClass::forest, "altitude < treeline"},
                          {LandCoverClass::pasture, "lake > 0.5"},
                          {LandCoverClass::water, "sea > 0.5"}}};
  const Grid<LandCoverClass> classes =
      apply_class_rules(rules, parameters, dem, silent_progress()).classes.cells;
  std::size_t of[4] = {};
  for (std::size_t i = 0; i < classes.size(); ++i) {
    LandCoverClass expected =
        dem.altitude_m[i] < grids.treeline_m[i] ? LandCoverClass::forest : LandCoverClass::rock;
    if (grids.lake[i] > 0.5F) expected = LandCoverClass::pasture;
    if (grids.sea[i] > 0.5F) expected = LandCoverClass::water;
    ASSERT_EQ(classes[i], expected) << i % 200 << " " << i / 200;
    ++of[expected == LandCoverClass::rock      ? 0
         : expected == LandCoverClass::forest  ? 1
         : expected == LandCoverClass::pasture ? 2
                                               : 3];
  }
  for (const std::size_t cells : of) EXPECT_GT(cells, 300U);
}

// In a file of layers, as functions and in expressions.
TEST(LayerClimate, LayersNameTreelineLakeAndSea) {
  const SurfaceLayers layers = parse_surface_layers(R"(version = 1
name = "words"
model = "product"
ground = { class = "rock" }
[[layers]]
name = "forest"
class = "forest"
when = "altitude < treeline - 100 and lake < 0.5 and sea < 0.5"
)",
                                                    "w.layers.toml");
  EXPECT_THAT(compile_layers(layers).inputs,
              testing::IsSupersetOf({"altitude", "treeline", "lake", "sea"}));
  EXPECT_TRUE(needs_climate({"treeline"}, {}));
  EXPECT_FALSE(needs_place({"lake", "sea"}, {})) << "they follow from the ground";
}

TEST(LayerClimate, WhatAUserGivesWins) {
  const Dem dem = tent();
  const test::Folder folder;
  Raster<float> given{Grid<float>(width, height, 7.25F), dem.transform, dem.crs};
  write_raster(folder / "given.tif", given);
  const std::string file = folder / "given.tif";
  const LayerClimateFiles files{
      .temperature = file, .rain = file, .radiation = file, .sky_view = file};
  const std::vector<std::string> all = {"temperature", "rain", "radiation", "sky_view"};
  const LayerClimateGrids grids =
      make_layer_climate(dem, all, files, {}, nobody, silent_progress());
  for (const Grid<float>* grid :
       {&grids.temperature_c, &grids.rain_mm, &grids.radiation, &grids.sky_view}) {
    ASSERT_TRUE(grid->same_size(dem.altitude_m));
    EXPECT_EQ((*grid)(11, 13), 7.25F);
  }
  EXPECT_FALSE(needs_place(all, files));
  EXPECT_TRUE(needs_place({"slope", "sky_view"}, {.radiation = file}));
  EXPECT_FALSE(needs_climate({"slope", "sky_view"}, {}));
  EXPECT_TRUE(needs_climate({"rain"}, {.temperature = file}));
}

TEST(LayerClimate, GroundWithoutCrsLiesAtTheLatitudeGiven) {
  const Dem dem = tent("");
  EXPECT_THROW(make_layer_climate(dem, {"radiation"}, {}, {}, nobody, silent_progress()), Error);
  const auto at = [&](double latitude_deg) {
    return make_layer_climate(dem, {"radiation"}, {}, latitude_deg, nobody, silent_progress())
        .radiation(30, 130);
  };
  EXPECT_GT(at(35.0), at(65.0));
  EXPECT_NEAR(static_cast<double>(at(47.3)),
              static_cast<double>(
                  make_layer_climate(tent(), {"radiation"}, {}, {}, nobody, silent_progress())
                      .radiation(30, 130)),
              60.0);
}

TEST(LayerClimate, TheSameForAnyThreads) {
  const Dem dem = tent();
  const std::vector<std::string> all = {"temperature", "rain", "radiation", "sky_view"};
  const auto made = [&](int threads) {
    const ThreadLimit limit(threads);
    return make_layer_climate(
        dem, all, {}, {}, [&] { return even_climate(dem); }, silent_progress());
  };
  const LayerClimateGrids one = made(1);
  const LayerClimateGrids three = made(3);
  EXPECT_EQ(one.temperature_c, three.temperature_c);
  EXPECT_EQ(one.rain_mm, three.rain_mm);
  EXPECT_EQ(one.radiation, three.radiation);
  EXPECT_EQ(one.sky_view, three.sky_view);
}

// Cells of a larger terrain: its climate, and the shadows of ground outside.
TEST(LayerClimate, AWindowHasTheClimateOfTheWholeAndItsShadows) {
  const Dem whole = tent();
  Climate climate = even_climate(whole);
  climate.nodes(1, 0).sea_level_c[0] += 24.0;  // 2 K warmer in the year's mean in one corner
  const PixelRect cells{10, 20, 50, 60};       // on the northern slope
  Dem window = whole;
  window.altitude_m = part_of(whole.altitude_m, cells);
  window.filled = part_of(whole.filled, cells);
  window.transform.origin_x += 10 * 20.0;
  window.transform.origin_y -= 20 * 20.0;
  const std::vector<std::string> names = {"temperature", "radiation", "sky_view"};
  const auto maker = [&] { return climate; };
  const LayerClimateGrids of_whole =
      make_layer_climate(whole, names, {}, {}, maker, silent_progress());
  const LayerClimateGrids joined =
      make_layer_climate(window, names, {}, {}, maker, silent_progress(), &whole);
  const LayerClimateGrids alone =
      make_layer_climate(window, names, {}, {}, maker, silent_progress());
  float apart_alone = 0.F;
  ASSERT_TRUE(joined.radiation.same_size(window.altitude_m));
  for (const auto [x, y] : test::cells({10, 10, 30, 30})) {
    EXPECT_NEAR(joined.temperature_c(x, y), of_whole.temperature_c(10 + x, 20 + y), 1e-4);
    EXPECT_NEAR(joined.radiation(x, y), of_whole.radiation(10 + x, 20 + y),
                0.01F * of_whole.radiation(10 + x, 20 + y));
    EXPECT_NEAR(joined.sky_view(x, y), of_whole.sky_view(10 + x, 20 + y), 0.005F);
    apart_alone = std::max(
        apart_alone, std::abs(alone.temperature_c(x, y) - of_whole.temperature_c(10 + x, 20 + y)));
  }
  EXPECT_GT(apart_alone, 0.2F) << "the climate is the whole's";
}

}  // namespace
}  // namespace belvedere
