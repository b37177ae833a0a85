#include "renderer/ground/scene_ground_map.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "base/cache/cache.h"
#include "base/error.h"
#include "renderer/world/scene_dem.h"
#include "renderer/world/scene_land_cover.h"
#include "renderer/world/world.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/notes.h"

namespace belvedere {
namespace {

using test::Notes;
using enum LandCoverClass;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

constexpr int map_cells = 120;
constexpr double map_cell_m = 200.0;
constexpr double west_m = 680000.0;
constexpr double south_m = 5240000.0;

// Two valleys that fall from north to south, along columns 30 and 90, each wide enough for an
// inferred river. The DEM's own cells are half as wide as those in which positions are given here.
class GroundMaps : public testing::Test {
 protected:
  GroundMaps() {
    constexpr int fine = 2 * map_cells;
    std::string dem = fmt::format("ncols {}\nnrows {}\nxllcorner {}\nyllcorner {}\ncellsize {}\n",
                                  fine, fine, west_m, south_m, 0.5 * map_cell_m);
    for (const auto [i, j] : test::cells(fine, fine)) {
      const double x = 0.5 * i - 0.25;
      const double y = 0.5 * j - 0.25;
      dem += fmt::format("{:.2f}{}",
                         900.0 - 1.2 * y + 6.0 * std::min(std::abs(x - 30), std::abs(x - 90)),
                         i == fine - 1 ? '\n' : ' ');
    }
    folder_.write("dem.asc", dem);
  }
  static glm::dvec2 at(double x, double y) {
    return {west_m + (x + 0.5) * map_cell_m, south_m + (map_cells - y - 0.5) * map_cell_m};
  }
  static std::string positions(const std::vector<glm::dvec2>& of_cells) {
    std::string text;
    for (const glm::dvec2 cell : of_cells)
      text += fmt::format("{}[{}, {}]", text.empty() ? "" : ", ", at(cell.x, cell.y).x,
                          at(cell.x, cell.y).y);
    return text;
  }
  static std::string feature(const std::string& properties, const std::string& type,
                             const std::string& coordinates) {
    return fmt::format(
        "{{\"type\": \"Feature\", \"properties\": {{{}}}, \"geometry\": {{\"type\": \"{}\", "
        "\"coordinates\": {}}}}}",
        properties, type, coordinates);
  }
  static std::string river() {
    return feature("\"kind\": \"river\"", "LineString",
                   "[" + positions({{33, 2}, {32, 60}, {33, 117}}) + "]");
  }
  static std::string area(const std::string& kind, double x0, double y0, double x1, double y1,
                          const std::string& more = "") {
    return feature("\"kind\": \"" + kind + "\"" + more, "Polygon",
                   "[[" + positions({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}}) + "]]");
  }
  void write(const std::string& features) const {
    folder_.write("map.geojson",
                  "{\"type\": \"FeatureCollection\", \"crs\": {\"type\": \"name\", \"properties\": "
                  "{\"name\": \"EPSG:32632\"}}, "
                  "\"features\": [" +
                      features + "]}");
  }
  LoadedScene scene(const std::string& more = "snap_m = 1000\n") const {
    return parse_scene(
        "version = 1\n[[terrain.sources]]\nfile = \"dem.asc\"\ncrs = "
        "\"EPSG:32632\"\n[[features]]\nsource = "
        "\"map.geojson\"\nkind_of = \"kind\"\n" +
            more,
        "mine.toml", folder_.path(), {});
  }
  LandCover cover(const LoadedScene& loaded, Progress& progress = silent_progress(),
                  const Cache& cache = no_cache()) const {
    const Dem dem = make_scene_dem(loaded, progress, cache);
    return make_scene_land_cover(loaded, dem, progress, cache);
  }
  // Whether there is water along a row between two columns.
  static bool has_water(const LandCover& cover, double row, double from, double to) {
    for (double x = from; x <= to; x += 0.02)
      if (cover.at(at(x, row).x, at(x, row).y) == water) return true;
    return false;
  }
  test::Folder folder_;
};

TEST_F(GroundMaps, RiversLieInTheirValleysAndGuessedOnesGiveWay) {
  write(river());
  const LandCover known = cover(scene());
  for (double row = 12; row < 110; row += 7) {
    EXPECT_TRUE(has_water(known, row, 29.0, 31.0)) << "the bottom of the valley, row " << row;
    EXPECT_FALSE(has_water(known, row, 31.6, 35.0)) << "where the map has it, row " << row;
  }
  EXPECT_FALSE(has_water(known, 110, 85, 95)) << "an inferred river";
  const LandCover both = cover(scene("snap_m = 1000\nkeep_inferred = true\n"));
  EXPECT_TRUE(has_water(both, 110, 85, 95));
  EXPECT_TRUE(has_water(both, 60, 29, 31));
}

TEST_F(GroundMaps, WithoutFeaturesThereAreGuessedRiversAlone) {
  write(area("road", 1, 1, 2, 2));
  const LandCover inferred = cover(scene());
  EXPECT_EQ(inferred.map, nullptr);
  ASSERT_NE(inferred.inferred, nullptr);
  EXPECT_TRUE(has_water(inferred, 110, 85, 95));
  for (const CoverRiver& river : inferred.inferred->centrelines())
    EXPECT_EQ(river.painted_as, water);
  // Down the valley without a gap, however narrow.
  for (double row = 60; row < 119; row += 0.7) EXPECT_TRUE(has_water(inferred, row, 88, 92)) << row;
}

TEST_F(GroundMaps, NothingIsLaidWhereRulesKnowNoRivers) {
  write(area("road", 1, 1, 2, 2));
  folder_.write("bare.toml",
                "version = 1\nname = \"bare\"\n[[layers]]\nclass = \"pasture\"\nwhen = \"1\"\n");
  const LandCover none = cover(scene("[land_cover]\nrules = \"bare.toml\"\n"));
  EXPECT_EQ(none.map, nullptr);
  EXPECT_EQ(none.inferred, nullptr);
  EXPECT_TRUE(none.below.empty());
}

TEST_F(GroundMaps, AreasOfAMapLieOverGuessedRivers) {
  write(area("glacier", 80, 70, 100, 90));
  const LandCover made = cover(scene());
  EXPECT_TRUE(has_water(made, 60, 85, 95));
  EXPECT_FALSE(has_water(made, 80, 85, 95));
  EXPECT_EQ(made.cell_at(at(90, 80).x, at(90, 80).y), made.below(180, 160));
}

TEST_F(GroundMaps, AreasHaveTheirClassAndLakesAreLevel) {
  write(area("glacier", 50, 50, 70, 70) + "," +
        area("lake", 28, 100, 32, 102, ", \"level\": 790.0") + "," +
        area("lake", 88, 20, 92, 22, ", \"level\": 3000.0"));
  const LoadedScene loaded = scene("level_of = \"level\"\n");
  Notes notes;
  const Dem dem = make_scene_dem(loaded, notes);
  for (int x = 58; x < 63; ++x) EXPECT_EQ(dem.altitude_m(x, 202), 790.F);
  EXPECT_NEAR(dem.altitude_m(180, 42), 900.0 - 1.2 * 21, 8.0)
      << "an altitude that cannot be is none";
  EXPECT_THAT(notes.all, Contains(HasSubstr("1 of 2 lakes have an altitude")));
  const LandCover made = make_scene_land_cover(loaded, dem, silent_progress());
  EXPECT_EQ(made.at(at(60, 60).x, at(60, 60).y), glacier);
  EXPECT_EQ(made.at(at(50.01, 60).x, at(50.01, 60).y), glacier) << "its outline is its own";
  EXPECT_NE(made.at(at(49.99, 60).x, at(49.99, 60).y), glacier);
  EXPECT_EQ(made.classes.cells(120, 120), glacier);
  EXPECT_EQ(made.at(at(30, 101).x, at(30, 101).y), water);
}

// Land is to the left of a line from north to south through column 60: the east is land, except for
// other features; an island is an area.
TEST_F(GroundMaps, CoastLinesBoundTheSea) {
  const std::string coast = feature("\"kind\": \"coastline\"", "LineString",
                                    "[" + positions({{60, -5}, {60, 40}}) + "]") +
                            ", " +
                            feature("\"kind\": \"coastline\"", "LineString",
                                    "[" + positions({{60, 40}, {60, 130}}) + "]");
  write(coast + ", " + area("coastline", 10, 50, 20, 60));
  const LoadedScene loaded = scene();
  const Dem dem = make_scene_dem(loaded, silent_progress());
  const GroundMap map = read_ground_map(loaded, dem, silent_progress());
  ASSERT_EQ(map.areas.size(), 1U);
  EXPECT_TRUE(map.areas[0].still);
  EXPECT_EQ(map.lakes.size(), 1U);
  const LandCover sea = cover(loaded);
  for (const double y : {5.3, 40.2, 90.7}) {
    EXPECT_EQ(sea.at(at(50, y).x, at(50, y).y), water);
    EXPECT_NE(sea.at(at(70, y).x, at(70, y).y), water);
  }
  EXPECT_NE(sea.at(at(15, 55).x, at(15, 55).y), water) << "the island";
  EXPECT_EQ(sea.at(at(25, 55).x, at(25, 55).y), water);
}

// The lake is too small to be found in the elevation model, and a river crosses it.
TEST_F(GroundMaps, NamesStandOnTheGroundOfThePicture) {
  write(area("lake", 31.0, 50.0, 33.0, 54.0) + ", " + river());
  const LoadedScene loaded = scene(
      "[camera]\nposition = [692000, 5236000]\nazimuth_deg = 0\npitch_deg = -20\nheight_m = "
      "9000\n[output]\nwidth = 96\nheight = 64\n[generalize]\nforeground = [1, 1, 1, 2, 2, 0]\n");
  const World world = make_world(loaded, silent_progress());
  const BareView bare = make_bare_view(loaded, silent_progress());
  EXPECT_EQ(*bare.generalized_m, world.terrain.generalized_m);
  EXPECT_EQ(bare.surface->vertices_m, world.surface->vertices_m);
  EXPECT_EQ(bare_view_of(world).view.camera.eye, bare.view.camera.eye);
  const LoadedScene without = scene("enabled = false\n[camera]\nposition = [692000, 5236000]\n");
  EXPECT_NE(make_scene_dem(without, silent_progress()).altitude_m, bare.dem->altitude_m)
      << "the lake is level";
}

TEST_F(GroundMaps, ACoastLineThatEndsOnTheTerrainIsSaidAndLeftOut) {
  write(feature("\"kind\": \"coastline\"", "LineString",
                "[" + positions({{60, -5}, {60, 40}}) + "]"));
  const LoadedScene loaded = scene();
  Notes notes;
  const Dem dem = make_scene_dem(loaded, notes);
  EXPECT_TRUE(read_ground_map(loaded, dem, silent_progress()).areas.empty());
  EXPECT_THAT(notes.all, Contains(AllOf(HasSubstr("a coastline begins or ends on the terrain"),
                                        HasSubstr("are left out"))));
}

TEST_F(GroundMaps, TownsThatArePointsAreAsLargeAsTheirPeople) {
  const auto town = [](const std::string& people) {
    return feature("\"kind\": \"town\"" + people, "Point", positions({{40, 60}}));
  };
  write(town(", \"n\": 50000"));
  const LoadedScene loaded = scene("population_of = \"n\"\n");
  const Dem dem = make_scene_dem(loaded, silent_progress());
  const GroundMap map = read_ground_map(loaded, dem, silent_progress());
  ASSERT_EQ(map.towns.size(), 1U);
  EXPECT_NEAR(map.towns[0].radius_m, std::sqrt(50000 * 170.0 / M_PI), 1.0);
  EXPECT_FALSE(map.keeps_towns);
  EXPECT_TRUE(map.keeps_rivers);
  write(town(""));
  Notes notes;
  EXPECT_TRUE(read_ground_map(scene(), dem, notes).towns.empty());
  EXPECT_THAT(notes.all, Contains(HasSubstr("population_of")));
}

TEST_F(GroundMaps, WhatAFileHoldsCountsForTheCache) {
  const Cache cache({.folder = folder_ / "cache", .limit_bytes = 0});
  write(river());
  const Grid<LandCoverClass> first = cover(scene(), silent_progress(), cache).classes.cells;
  Notes again;
  EXPECT_EQ(cover(scene(), again, cache).classes.cells, first);
  EXPECT_THAT(again.all, Contains(HasSubstr("moved to the bottoms"))) << "notes come along";
  write(river() + "," + area("forest", 50, 50, 70, 70));
  const LandCover second = cover(scene(), silent_progress(), cache);
  EXPECT_NE(second.classes.cells, first);
  EXPECT_EQ(second.classes.cells(120, 120), forest);
  EXPECT_EQ(cover(scene(), silent_progress(), no_cache()).classes.cells, second.classes.cells);
}

TEST_F(GroundMaps, AFileThatLiesElsewhereIsSaidWithBothExtents) {
  folder_.write("map.geojson",
                "{\"type\": \"FeatureCollection\", \"features\": [" +
                    feature("\"kind\": \"river\"", "LineString", "[[47.1, 11.1], [47.2, 11.2]]") +
                    "]}");
  LoadedScene loaded = scene();
  EXPECT_NO_THROW(cover(loaded)) << "with a kind column they may be other than ground";
  loaded.scene.features[0].kind_of.clear();
  loaded.scene.features[0].kind = "river";
  EXPECT_THAT(test::usage_error([&] { cover(loaded); }),
              AllOf(HasSubstr("map.geojson"), HasSubstr("none of 1 features lies on the terrain"),
                    HasSubstr("E 680000 … 704000")));
}

}  // namespace
}  // namespace belvedere
