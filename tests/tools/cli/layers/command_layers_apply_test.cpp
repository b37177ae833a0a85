// `belvedere layers apply` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/land_cover_class.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/scene_land_cover.h"
#include "terrain/io/dem.h"
#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr char two_layers[] = R"(version = 1
name = "two"
ground = { class = "rock", colour = "#804020" }
[[inputs]]
name = "altitude"
low = 0
high = 1200
[[layers]]
name = "grass"
class = "pasture"
colour = "#40c040"
[layers.functions]
altitude = { high = 1500 }
[[layers]]
name = "snow"
class = "snow"
colour = "#ffffff"
[layers.functions]
altitude = { low = 2000 }
)";

class LayersApply : public Program {
 protected:
  // Rises to the east from 100 m, 20 m a column of 100 m; a void at (5, 5).
  std::string write_ramp() const {
    Raster<float> raster{
        Grid<float>(120, 90), {680000.0, 5260000.0, 100.0, 100.0}, normalize_crs("EPSG:32632")};
    for (const auto [x, y] : test::cells(120, 90))
      raster.cells(x, y) = 100.F + 20.F * static_cast<float>(x);
    raster.cells(5, 5) = std::nanf("");
    write_raster(path("dem.tif"), raster);
    return path("dem.tif");
  }
  std::string write_layers(const std::string& text = two_layers) const {
    test::write_bytes(path("two.layers.toml"), text);
    return path("two.layers.toml");
  }
  Raster<std::int32_t> codes(const std::string& name, int band = 1) const {
    RasterSource source;
    source.path = path(name);
    source.band = band;
    return read_codes(source);
  }
};

TEST_F(LayersApply, WritesClassesColoursAndShares) {
  ASSERT_THAT(run({"layers", "apply", write_layers(), "--dem", write_ramp(), "--out", path("c.tif"),
                   "--colour", path("rgb.tif"), "--shares", path("s.tif")}),
              Prints(AllOf(HasSubstr("pasture"), HasSubstr("rock"), HasSubstr("snow"),
                           HasSubstr("altitude"))));
  const Raster<std::int32_t> classes = codes("c.tif");
  ASSERT_EQ(classes.cells.width(), 120);
  EXPECT_EQ(classes.transform, (GeoTransform{680000.0, 5260000.0, 100.0, 100.0}));
  for (const auto [x, y] : test::cells(120, 90)) {
    const auto expected = x <= 70  ? LandCoverClass::pasture
                          : x < 95 ? LandCoverClass::rock
                                   : LandCoverClass::snow;
    ASSERT_EQ(classes.cells(x, y), x == 5 && y == 5 ? -1 : static_cast<int>(expected))
        << x << ", " << y;
  }
  EXPECT_EQ(codes("rgb.tif", 2).cells(10, 10), 0xc0);
  EXPECT_EQ(codes("rgb.tif", 1).cells(80, 10), 0x80);
  EXPECT_EQ(codes("s.tif", 1).cells(10, 10), 255);
  EXPECT_EQ(codes("s.tif", 2).cells(10, 10), 0);
  EXPECT_EQ(codes("s.tif", 2).cells(110, 10), 255);
  // A legend that a scene can read.
  EXPECT_THAT(read_bytes(path("c.legend.toml")), HasSubstr("10 = { label = "));
}

// More than a tenth of the ground lies above 1200 m, the limit of the layers.
TEST_F(LayersApply, WarnsWhereTheGroundLiesOutside) {
  const Outcome outcome = run(
      {"layers", "apply", write_layers(), "--dem", write_ramp(), "--out", path("c.tif"), "--json"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("warning: 53 % of the ground has altitude outside 0…1200"));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("\"outside\""), HasSubstr("\"pasture\""),
                                 HasSubstr("they extrapolate there")));
}

TEST_F(LayersApply, NothingIsWrittenWhereSomethingIsWrong) {
  const std::string dem = write_ramp();
  const auto refused = [&](const std::string& text, const std::string& words) {
    EXPECT_THAT(run({"layers", "apply", write_layers(text), "--dem", dem, "--out", path("c.tif"),
                     "--shares", path("s.tif")}),
                Ends(2, HasSubstr(words)));
    for (const char* name : {"c.tif", "s.tif", "c.tmp.tif", "s.tmp.tif", "c.legend.toml"})
      EXPECT_FALSE(std::filesystem::exists(path(name))) << name;
  };
  refused("version = 1\n[[layers]]\nname = \"a\"\nparent = \"a\"\n",
          "two.layers.toml:4:10: layer is its own ancestor: a → a");
  refused("version = 1\nlayers = []\n", "no layers");
  EXPECT_THAT(run({"layers", "apply", write_layers(), "--dem", dem, "--out", path("c.tif"),
                   "--colour", path("c.tif")}),
              Ends(2, HasSubstr("is also the result of --out")));
}

TEST_F(LayersApply, ThreadsChangeNoCell) {
  const std::string dem = write_ramp();
  std::string text = two_layers;
  text += "noise = { amplitude = 0.8, bias = 0.5 }\n";
  text.replace(
      text.find("altitude = { low = 2000 }\n"), 26,
      "altitude = { low = 1500, width = 900 }\n[[layers]]\nname = \"third\"\nclass = \"scree\"\n");
  const std::string layers = write_layers(text);
  ASSERT_EQ(run({"layers", "apply", layers, "--dem", dem, "--out", path("a.tif"), "--threads", "1"})
                .status,
            0);
  ASSERT_EQ(run({"layers", "apply", layers, "--dem", dem, "--out", path("b.tif"), "--threads", "3"},
                without_cache())
                .status,
            0);
  EXPECT_EQ(codes("a.tif").cells, codes("b.tif").cells);
  ASSERT_EQ(
      run({"layers", "apply", layers, "--dem", dem, "--out", path("c.tif"), "--seed", "2"}).status,
      0);
  EXPECT_NE(codes("a.tif").cells, codes("c.tif").cells);
}

// A cone of 30 m cells whose classes depend on each input that is computed; thresholds from the
// file, not from the test.
class LayersOfClimate : public LayersApply {
 protected:
  std::string write_cone(const std::string& crs = "EPSG:32632") const {
    Raster<float> raster{Grid<float>(90, 80),
                         {680000.0, 5260000.0, 30.0, 30.0},
                         crs.empty() ? crs : normalize_crs(crs)};
    for (const auto [x, y] : test::cells(90, 80))
      raster.cells(x, y) = 2500.F - 15.F * static_cast<float>(std::hypot(x - 45.3, y - 39.7));
    write_raster(path("cone.tif"), raster);
    return path("cone.tif");
  }
  std::string write_sunny() const {
    test::write_bytes(path("sunny.layers.toml"), R"(version = 1
ground = { class = "rock" }
[[inputs]]
name = "radiation"
low = 0
high = 10000
[[layers]]
name = "dry"
class = "pasture"
noise = { scale_m = 300, amplitude = 0.4, bias = 0.8 }
[layers.functions]
radiation = { low = 4500, width = 500 }
[[layers]]
name = "cold"
class = "snow"
when = "temperature < 0"
[[layers]]
name = "wet"
class = "forest"
when = "rain > 900 and sky_view < 0.9 and temperature > 3"
)");
    return path("sunny.layers.toml");
  }
};

TEST_F(LayersOfClimate, ClimateIsComputedWhereItIsNotGiven) {
  const Outcome outcome =
      run({"layers", "apply", write_sunny(), "--dem", write_cone(), "--out", path("c.tif")});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Grid<std::int32_t> cells = codes("c.tif").cells;
  // Sun on the south side, none on the north side; the top is cold.
  EXPECT_EQ(cells(45, 70), static_cast<int>(LandCoverClass::pasture));
  EXPECT_EQ(cells(45, 10), static_cast<int>(LandCoverClass::rock));
  EXPECT_EQ(cells(45, 39), static_cast<int>(LandCoverClass::snow));
  ASSERT_EQ(run({"layers", "apply", write_sunny(), "--dem", write_cone(), "--out", path("one.tif"),
                 "--threads", "1"},
                without_cache())
                .status,
            0);
  EXPECT_EQ(cells, codes("one.tif").cells);
}

TEST_F(LayersOfClimate, ASceneGetsTheSameClasses) {
  const Outcome outcome = run({"layers", "apply", write_sunny(), "--dem", write_cone(), "--out",
                               path("c.tif"), "--seed", "5"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const LoadedScene scene = parse_scene(
      "version = 1\nseed = 5\n[[terrain.sources]]\nfile = \"cone.tif\"\n[land_cover]\nlayers = "
      "\"sunny.layers.toml\"\n",
      "s.toml", path(""), {});
  const LandCover cover =
      make_scene_land_cover(scene, make_scene_dem(scene, silent_progress()), silent_progress());
  const Grid<std::int32_t> applied = codes("c.tif").cells;
  ASSERT_EQ(cover.classes.cells.size(), applied.size());
  for (std::size_t i = 0; i < applied.size(); ++i)
    ASSERT_EQ(static_cast<int>(cover.classes.cells[i]), applied[i]) << i;
}

TEST_F(LayersOfClimate, StationsAndRastersWin) {
  const std::string dem = write_cone();
  const auto snow = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"layers", "apply", write_sunny(), "--dem",
                                          dem,      "--out", path("c.tif")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_THAT(run(arguments), Ends(0));
    const Grid<std::int32_t> cells = codes("c.tif").cells;
    return std::count(cells.begin(), cells.end(), static_cast<int>(LandCoverClass::snow));
  };
  Raster<float> warm{
      Grid<float>(90, 80, 12.F), {680000.0, 5260000.0, 30.0, 30.0}, normalize_crs("EPSG:32632")};
  write_raster(path("warm.tif"), warm);
  EXPECT_GT(snow({}), 0);
  EXPECT_EQ(snow({"--temperature", path("warm.tif")}), 0);
  // 0 °C at 2000 m by ten stations: snow above that alone.
  std::string text = "name,lon,lat,altitude_m,t_year\n";
  for (int i = 0; i < 10; ++i)
    text += "S,11.4,47." + std::to_string(30 + i) + "," + std::to_string(500 + 200 * i) + "," +
            std::to_string(9.0 - 1.2 * i) + "\n";
  test::write_bytes(path("stations.csv"), text);
  EXPECT_NEAR(static_cast<double>(snow({"--stations", path("stations.csv")})),
              3.14159 * 500.0 * 500.0 / 225.0, 60.0);
}

TEST_F(LayersOfClimate, GroundWithoutCoordinateSystemNeedsItsLatitude) {
  const std::string dem = write_cone("");
  EXPECT_THAT(run({"layers", "apply", write_sunny(), "--dem", dem, "--out", path("c.tif")}),
              Ends(2, HasSubstr("--latitude")));
  EXPECT_FALSE(std::filesystem::exists(path("c.tif")));
  const Outcome placed = run(
      {"layers", "apply", write_sunny(), "--dem", dem, "--out", path("c.tif"), "--latitude", "47"});
  EXPECT_EQ(placed.status, 0) << placed.err;
}

}  // namespace
}  // namespace belvedere
