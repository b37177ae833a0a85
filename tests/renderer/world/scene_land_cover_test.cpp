#include "renderer/world/scene_land_cover.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "base/cache/cache.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// The rules see glacier east of 501 km, snow north of 5199 km, which wins, and forest elsewhere.
// The raster tells three columns of classes apart, on cells of its own.
class RefinedLandCover : public testing::Test {
 protected:
  static constexpr double east = 500000.0;
  static constexpr double north = 5200000.0;

  static Dem level() {
    return make_dem(
        {Grid<float>(20, 20, 1000.F), {east, north, 100.0, 100.0}, normalize_crs("EPSG:32632")});
  }
  LandCover refined(const std::string& refine) const {
    folder_.write("rules.toml",
                  "version = 1\nname = \"two\"\n[parameters]\nspeck_cells = 0\n[[layers]]\nclass = "
                  "\"forest\"\nwhen = \"1\"\n"
                  "[[layers]]\nclass = \"glacier\"\nwhen = \"easting > 501000\"\n[[layers]]\nclass "
                  "= \"snow\"\nwhen = \"northing > 5199000\"\n");
    Raster<float> codes{
        Grid<float>(50, 50), {east, north, 40.0, 40.0}, normalize_crs("EPSG:32632")};
    for (const auto [x, y] : test::cells(50, 50)) codes.cells(x, y) = code(x);
    write_raster(folder_ / "cover.tif", codes);
    const LoadedScene scene = parse_scene(
        "version = 1\n[land_cover]\nlegend = \"esa_worldcover\"\nrules = \"rules.toml\"\n" +
            refine + "[[land_cover.sources]]\nfile = \"cover.tif\"\n",
        "s.toml", folder_.path(), {});
    return make_scene_land_cover(scene, level(), silent_progress());
  }
  // ESA WorldCover: grassland, bare ground, trees, in stripes one cell wide.
  static float code(int x) { return x % 3 == 0 ? 30.F : x % 3 == 1 ? 60.F : 10.F; }
  static LandCoverClass as_read(int x) { return x % 3 == 0 ? pasture : x % 3 == 1 ? rock : forest; }

  test::Folder folder_;
};

TEST_F(RefinedLandCover, ChangesTheNamedClassWhereTheRulesSeeTheOther) {
  const LandCover cover = refined("refine = { glacier = \"rock\", snow = \"pasture\" }\n");
  ASSERT_EQ(cover.classes.cells.width(), 50);
  int glaciers = 0;
  int snows = 0;
  for (const auto [x, y] : test::cells(50, 50)) {
    // The rules stand on the DEM's cells of 100 m: the border lies between columns 9 and 10, and
    // rows 9 and 10; cells of 40 m have their centres at (n + 0.5) · 0.4 of those.
    const bool east_of = (x + 0.5) * 0.4 > 10.0;
    const bool north_of = (y + 0.5) * 0.4 < 10.0;
    const LandCoverClass read = as_read(x);
    const LandCoverClass expected = read == rock && east_of && !north_of ? glacier
                                    : read == pasture && north_of        ? snow
                                                                         : read;
    ASSERT_EQ(cover.classes.cells(x, y), expected) << x << ", " << y;
    glaciers += expected == glacier ? 1 : 0;
    snows += expected == snow ? 1 : 0;
  }
  EXPECT_GT(glaciers, 100);
  EXPECT_GT(snows, 200);
}

// Snow lies north of a line, forest south of it; a step is as wide as a cell.
TEST(ErodedLandCover, DrawsBackInTheScene) {
  const test::Folder folder;
  folder.write("rules.toml",
               "version = 1\nname = \"two\"\n[parameters]\nspeck_cells = 0\n[[layers]]\nclass = "
               "\"forest\"\nwhen = \"1\"\n"
               "[[layers]]\nclass = \"snow\"\nwhen = \"northing > 5199000\"\n");
  const auto snow_rows = [&](const std::string& erode) {
    const Dem level = make_dem({Grid<float>(400, 40, 1000.F),
                                {500000.0, 5200000.0, 50.0, 50.0},
                                normalize_crs("EPSG:32632")});
    const LoadedScene scene = parse_scene(
        "version = 1\n[land_cover]\nrules = \"rules.toml\"\n" + erode, "s.toml", folder.path(), {});
    const LandCover cover = make_scene_land_cover(scene, level, silent_progress());
    return static_cast<double>(
               std::count(cover.classes.cells.begin(), cover.classes.cells.end(), snow)) /
           400.0;
  };
  EXPECT_EQ(snow_rows(""), 20.0);
  EXPECT_NEAR(snow_rows("erode = { snow = 4 }\n"), 16.0, 0.7);
  EXPECT_NEAR(snow_rows("erode = { forest = 4 }\n"), 24.0, 0.7);
}

TEST_F(RefinedLandCover, WithoutTheKeyTheRasterHoldsAlone) {
  const LandCover cover = refined("");
  for (const auto [x, y] : test::cells(50, 50)) ASSERT_EQ(cover.classes.cells(x, y), as_read(x));
}

// A scene's layers replace rules; its settings are those of the layers.
TEST(LayeredLandCover, LayersOfTheSceneSayWhatTheGroundIs) {
  const test::Folder folder;
  folder.write("two.layers.toml",
               "version = 1\nground = { class = \"forest\" }\n[[inputs]]\nname = \"altitude\"\nlow "
               "= 0\nhigh = 3000\n[parameters]\nline_m = 5000\n"
               "[[layers]]\nname = \"ice\"\nclass = \"glacier\"\nwhen = \"altitude > line_m\"\n");
  Grid<float> altitude(20, 20, 1000.F);
  for (const auto [x, y] : test::cells({12, 0, 20, 20})) altitude(x, y) = 2000.F;
  const Dem dem =
      make_dem({altitude, {500000.0, 5200000.0, 100.0, 100.0}, normalize_crs("EPSG:32632")});
  const auto cover = [&](const std::string& settings) {
    const LoadedScene scene =
        parse_scene("version = 1\n[land_cover]\nlayers = \"two.layers.toml\"\n" + settings,
                    "s.toml", folder.path(), {});
    return make_scene_land_cover(scene, dem, silent_progress()).classes.cells;
  };
  for (const LandCoverClass id : cover("")) ASSERT_EQ(id, forest);
  const Grid<LandCoverClass> low = cover("settings = { line_m = 1500 }\n");
  for (const auto [x, y] : test::cells(20, 20))
    ASSERT_EQ(low(x, y), x < 12 ? forest : glacier) << x << ", " << y;
  EXPECT_THROW(cover("settings = { line = 1500 }\n"), Error);
}

// Colours are added only if a scene asks for them: of the layers, also where a raster has the
// classes, also from the cache.
TEST_F(RefinedLandCover, TheLayersColoursComeWithLayersOrARaster) {
  folder_.write("two.layers.toml",
                "version = 1\nground = { class = \"forest\", colour = \"#102030\" }\n"
                "[[layers]]\nname = \"ice\"\nclass = \"glacier\"\ncolour = \"#a0b0c0\"\nwhen = "
                "\"relief_180 > -1000\"\n");
  const Cache cache({.folder = folder_ / "cache", .limit_bytes = 0});
  const auto cover = [&](const std::string& keys) {
    const LoadedScene scene =
        parse_scene("version = 1\n[land_cover]\nlayers = \"two.layers.toml\"\n" + keys, "s.toml",
                    folder_.path(), {});
    return make_scene_land_cover(scene, level(), silent_progress(), cache);
  };
  for (int run = 0; run < 2; ++run) {
    EXPECT_TRUE(cover("").colours.cells.empty());
    const LandCover made = cover("colours = \"layers\"\n");
    ASSERT_EQ(made.colours.cells.width(), 20);
    EXPECT_EQ(made.colours.transform, level().transform);
    for (const GroundColour& colour : made.colours.cells)
      ASSERT_EQ(colour, GroundColour(0xa0, 0xb0, 0xc0, 255));
  }
  refined("");  // writes the raster
  const LandCover both = cover(
      "colours = \"layers\"\nlegend = \"esa_worldcover\"\n[[land_cover.sources]]\nfile = "
      "\"cover.tif\"\n");
  for (int x = 0; x < 50; ++x)
    EXPECT_EQ(both.classes.cells(x, 7), as_read(x)) << "the raster's classes stay";
  EXPECT_EQ(both.colours.cells(3, 3), GroundColour(0xa0, 0xb0, 0xc0, 255));
}

// With the colours come bumps and beds of lakes, at the scene's height, also from the cache; with
// palette colours neither.
TEST(LayeredLandCover, BumpsAndBedsComeWithTheLayersColours) {
  const test::Folder folder;
  folder.write("rough.layers.toml",
               "version = 1\nground = { class = \"rock\", colour = \"#605040\" }\n"
               "[[layers]]\nname = \"stones\"\nclass = \"scree\"\nwhen = \"altitude > "
               "1020\"\nroughness = { height_m = 3, length_m = 40 }\n"
               "[[layers]]\nname = \"lake\"\nclass = \"water\"\ncolour = \"#0000ff\"\nwhen = "
               "\"lake > 0.5\"\n");
  const Grid<float> altitude = test::grid_of(80, 80, [&](int x, int y) {
    return 900.0 + 4.0 * std::max(0.0, std::hypot(x - 40.0, y - 40.0) - 15.0);
  });
  const Dem dem =
      make_dem({altitude, {500000.0, 5200000.0, 50.0, 50.0}, normalize_crs("EPSG:32632")});
  const Cache cache({.folder = folder / "cache", .limit_bytes = 0});
  const auto cover = [&](const std::string& keys) {
    const LoadedScene scene =
        parse_scene("version = 1\n[land_cover]\nlayers = \"rough.layers.toml\"\n" + keys, "s.toml",
                    folder.path(), {});
    return make_scene_land_cover(scene, dem, silent_progress(), cache);
  };
  for (int run = 0; run < 2; ++run) {
    EXPECT_TRUE(cover("").relief.bumps.empty());
    EXPECT_TRUE(cover("").relief.lake_depth_m.empty());
    const LandCover made = cover("colours = \"layers\"\n");
    ASSERT_EQ(made.relief.bumps.size(), 1U);
    EXPECT_EQ(made.relief.transform, dem.transform);
    EXPECT_EQ(made.relief.bumps[0].height_m, 3.0);
    EXPECT_EQ(made.relief.bumps[0].share(40, 20), 0.F);
    EXPECT_EQ(made.relief.bumps[0].share(78, 5), 1.F);
    EXPECT_EQ(made.classes.cells(40, 40), water);
    EXPECT_GT(made.relief.lake_depth_m(40, 40), made.relief.lake_depth_m(30, 40));
    EXPECT_EQ(made.relief.lake_depth_m(10, 40), 0.F);
    EXPECT_EQ(made.colours.cells(30, 40), GroundColour(0x60, 0x50, 0x40, 255))
        << "the bed is dry ground, not the water's colour";
    const LandCover other = cover("colours = \"layers\"\nbumps = 2.5\nlake_beds = false\n");
    EXPECT_EQ(other.relief.bumps[0].height_m, 7.5);
    EXPECT_TRUE(other.relief.lake_depth_m.empty());
    EXPECT_TRUE(cover("colours = \"layers\"\nbumps = 0\n").relief.bumps.empty());
  }
}

// Layers that need the climate get that of the scene, and the cache distinguishes climates.
TEST(LayersInAScene, HangOnItsClimateAlsoFromTheCache) {
  const test::Folder folder;
  folder.write("cold.layers.toml",
               "version = 1\nground = { class = \"rock\" }\n[[layers]]\nname = \"cold\"\nclass = "
               "\"snow\"\nwhen = \"temperature < 0\"\n");
  std::string stations = "name,lon,lat,altitude_m,t_year\n";
  for (int i = 0; i < 10; ++i)  // 0 °C at 1500 m, at 2500 m where they are warmer
    stations += "S,9.1,46." + std::to_string(90 + i % 10) + "," + std::to_string(500 + 200 * i) +
                "," + std::to_string(6.0 - 1.2 * i) + "\n";
  folder.write("stations.csv", stations);
  Grid<float> altitude(40, 20);
  for (const auto [x, y] : test::cells(40, 20)) altitude(x, y) = 100.F * static_cast<float>(x);
  const auto made = [&](const std::string& climate, const std::string& crs, const Cache& cache) {
    const Dem dem = make_dem(
        {altitude, {500000.0, 5200000.0, 100.0, 100.0}, crs.empty() ? crs : normalize_crs(crs)});
    const LoadedScene scene = parse_scene(
        "version = 1\n[land_cover]\nlayers = \"cold.layers.toml\"\n[climate]\n" + climate, "s.toml",
        folder.path(), {});
    return make_scene_land_cover(scene, dem, silent_progress(), cache).classes.cells;
  };
  const Cache cache({.folder = folder / "cache", .limit_bytes = 0});
  for (int run = 0; run < 2; ++run) {
    const Grid<LandCoverClass> here = made("", "EPSG:32632", cache);
    const Grid<LandCoverClass> cool = made("stations = \"stations.csv\"\n", "EPSG:32632", cache);
    const Grid<LandCoverClass> north = made("latitude_deg = 70\n", "", cache);
    for (int x = 0; x < 40; ++x) {
      ASSERT_EQ(cool(x, 10), x <= 15 ? rock : snow) << x;
      // In the Alps the mean of the year is 0 °C between 2000 and 2700 m; at 70° N below 1000 m.
      if (x < 20 || x > 27) {
        ASSERT_EQ(here(x, 10), x < 20 ? rock : snow) << x;
      }
      if (x > 10) {
        ASSERT_EQ(north(x, 10), snow) << x;
      }
    }
  }
  const Error error = test::error_of([&] { made("", "", cache); });
  EXPECT_EQ(error.where(), "climate.latitude_deg");
}

// The ground of a scene at a place on the Earth, 12 km square.
Dem valley_at(double latitude_deg, double longitude_deg) {
  Grid<float> altitude(40, 40);
  for (const auto [x, y] : test::cells(40, 40))
    altitude(x, y) = 600.F + 40.F * static_cast<float>(x);
  return make_dem({altitude,
                   {0.0, 0.0, 300.0, 300.0},
                   normalize_crs(fmt::format("+proj=laea +lat_0={} +lon_0={} +datum=WGS84 +units=m",
                                             latitude_deg, longitude_deg))});
}

// P44: in a warmer or colder time treeline, snow and ice are where the air is as warm, some 150 m
// higher for each kelvin; the ice of the Alps a little less, because more falls on their heights.
TEST(AnotherTime, ShiftsTheLinesOfTreesSnowAndIceByAHundredAndFiftyMetresAKelvin) {
  const Sea no_sea;
  const auto rules = [&](const Dem& dem, const std::string& climate) {
    const LoadedScene scene = parse_scene("version = 1\n[climate]\n" + climate, "s.toml", "", {});
    return know_whole(scene, dem, no_sea).rules;
  };
  const Dem karwendel = valley_at(47.4, 11.5);
  const Dem aoraki = valley_at(-43.6, 170.15);
  for (const auto& [dem, kelvin, ice_tolerance_m] :
       {std::tuple(&karwendel, 1.0, 30.0), std::tuple(&karwendel, -6.0, 30.0),
        std::tuple(&aoraki, -3.0, 20.0)}) {
    const RuleClimate now = rules(*dem, "").climate;
    const RuleClimate then = rules(*dem, fmt::format("warmer_k = {}\n", kelvin)).climate;
    const auto shift = [&, k = kelvin](const Grid<float>& line, const Grid<float>& before) {
      return static_cast<double>(line(0, 0) - before(0, 0)) / k;
    };
    EXPECT_NEAR(shift(then.treeline_m, now.treeline_m), 150.0, 20.0) << kelvin;
    EXPECT_NEAR(shift(then.snow_line_m, now.snow_line_m), 150.0, ice_tolerance_m) << kelvin;
    EXPECT_NEAR(shift(then.ice_line_m, now.ice_line_m), 150.0, ice_tolerance_m) << kelvin;
  }
  // More snow, lower ice; what grows is told by warmth alone.
  const RuleClimate now = rules(karwendel, "").climate;
  const RuleClimate wet = rules(karwendel, "wetter = 0.5\n").climate;
  EXPECT_LT(wet.ice_line_m(0, 0), now.ice_line_m(0, 0) - 100.F);
  EXPECT_EQ(wet.treeline_m(0, 0), now.treeline_m(0, 0));
  EXPECT_NEAR(wet.rain_mm[3](0, 0), 1.5F * now.rain_mm[3](0, 0), 0.1F);
}

TEST(AnotherTime, ClearingsTurnForestToPasture) {
  const Dem dem = valley_at(47.4, 11.5);
  const auto forest_share = [&](const std::string& text) {
    const LoadedScene scene = parse_scene("version = 1\n" + text, "s.toml", "", {});
    const Grid<LandCoverClass> classes =
        make_scene_land_cover(scene, dem, silent_progress()).classes.cells;
    return static_cast<double>(std::count(classes.begin(), classes.end(), forest)) /
           static_cast<double>(classes.size());
  };
  const double now = forest_share("");
  EXPECT_LT(forest_share("[climate]\nclearings = 1\n"), 0.6 * now);
  EXPECT_GT(forest_share("[climate]\nclearings = -1\n"), now);
  EXPECT_EQ(forest_share("[climate]\nclearings = 1\n[land_cover.settings]\nclearings = 0\n"), now);
}

// P41: under clouds the rules and the layers see less difference between sunny and shaded slopes.
TEST(AnotherTime, SunshineIsAnInputOfRulesAndLayers) {
  const test::Folder folder;
  folder.write("sunny.layers.toml",
               "version = 1\nground = { class = \"rock\" }\n[[layers]]\nname = \"sunny\"\nclass = "
               "\"pasture\"\nwhen = \"radiation > 4000\"\n");
  folder.write("rules.toml",
               "version = 1\nname = \"sunny\"\n[parameters]\nspeck_cells = 0\n[[layers]]\nclass = "
               "\"rock\"\nwhen = \"1\"\n[[layers]]\nclass = \"pasture\"\nwhen = \"sun < 0.9 and "
               "treeline > 0\"\n");
  // A roof of 27°, half of it to the north.
  Dem dem = valley_at(47.4, 11.5);
  for (const auto [x, y] : test::cells(40, 40))
    dem.altitude_m(x, y) = 3000.F - 150.F * std::abs(static_cast<float>(y) - 19.5F);
  const auto pastures = [&](const std::string& cover, const std::string& climate) {
    const LoadedScene scene = parse_scene(
        "version = 1\n[land_cover]\n" + cover + "[climate]\nlapse_k_per_km = 6\n" + climate,
        "s.toml", folder.path(), {});
    const Grid<LandCoverClass> classes =
        make_scene_land_cover(scene, dem, silent_progress()).classes.cells;
    return std::count(classes.begin(), classes.end(), pasture);
  };
  const std::string layers = "layers = \"sunny.layers.toml\"\n";
  const std::string rules = "rules = \"rules.toml\"\n";
  EXPECT_GT(pastures(layers, ""), 100);
  EXPECT_EQ(pastures(layers, "sunshine = [0.1]\n"), 0);
  EXPECT_GT(pastures(rules, ""), 100);
  EXPECT_EQ(pastures(rules, "sunshine = [0]\n"), 0);
  const Error error = test::error_of([&] { pastures(rules, "sunshine = [0.4, 0.5]\n"); });
  EXPECT_NE(std::string(error.what()).find("climate.sunshine"), std::string::npos) << error.what();
}

}  // namespace
}  // namespace belvedere
