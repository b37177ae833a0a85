#include "renderer/world/scene_towns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "renderer/world/scene_land_cover.h"
#include "terrain/io/raster_io.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/notes.h"

namespace belvedere {
namespace {

using test::Notes;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

// Level ground, 6 km square, that falls a little to the west: no lake. Its centre is E 683000 N
// 5237000.
Dem plain() {
  Raster<float> raster{
      Grid<float>(200, 200), {680000.0, 5240000.0, 30.0, 30.0}, normalize_crs("EPSG:32632")};
  for (const auto [x, y] : test::cells(200, 200))
    raster.cells(x, y) = 700.F + 0.4F * static_cast<float>(x);
  return make_dem(std::move(raster));
}

class SceneTowns : public testing::Test {
 protected:
  LoadedScene scene(const std::string& text) const {
    return parse_scene("version = 1\n" + text, "s.toml", folder_.path(), {});
  }
  std::vector<KnownTown> towns(const std::string& text) {
    notes_.all.clear();
    return make_scene_towns(scene(text), plain(), notes_);
  }

  test::Folder folder_;
  Notes notes_;
};

TEST_F(SceneTowns, ByMetresByDegreesAndFromAFile) {
  folder_.write("towns.csv", "name,lon,lat,population\nHall,11.43,47.28,14000\n");
  const std::vector<KnownTown> all = towns(
      "[land_cover]\ntowns_file = \"towns.csv\"\n"
      "[[land_cover.towns]]\nname = \"A\"\nposition = [682000, 5238000]\nradius_m = 400\n"
      "[[land_cover.towns]]\nposition_lonlat = [11.42, 47.27]\nradius_m = 300\n");
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].position, glm::dvec2(682000.0, 5238000.0));
  EXPECT_EQ(all[0].radius_m, 400.0);
  EXPECT_LT(
      glm::length(all[1].position - transform_point("EPSG:4326", "EPSG:32632", {11.42, 47.27})),
      1e-3);
  EXPECT_EQ(all[2].name, "Hall");
  EXPECT_TRUE(notes_.all.empty());
}

TEST_F(SceneTowns, FromAGeoPackage) {
  if (std::system("command -v ogr2ogr > /dev/null") != 0)
    GTEST_SKIP() << "needs GDAL's program ogr2ogr";
  const std::string csv = folder_.write("t.csv", "name,lon,lat,radius_m\nHall,11.43,47.28,500\n");
  ASSERT_EQ(
      std::system(("ogr2ogr -oo X_POSSIBLE_NAMES=lon -oo Y_POSSIBLE_NAMES=lat -a_srs EPSG:4326 '" +
                   (folder_ / "t.gpkg") + "' '" + csv + "' > /dev/null 2>&1")
                      .c_str()),
      0);
  const std::vector<KnownTown> all = towns("[land_cover]\ntowns_file = \"t.gpkg\"\n");
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].radius_m, 500.0);
  EXPECT_LT(
      glm::length(all[0].position - transform_point("EPSG:4326", "EPSG:32632", {11.43, 47.28})),
      1e-3);
}

TEST_F(SceneTowns, OutsideTheTerrainTheyAreNotedAndFarOffLeftOut) {
  const std::vector<KnownTown> all = towns(
      "[[land_cover.towns]]\nname = \"Near\"\nposition = [687000, 5238000]\nradius_m = 400\n"
      "[[land_cover.towns]]\nname = \"Far\"\nposition = [783000, 5238000]\nradius_m = 400\n");
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].name, "Near");
  EXPECT_THAT(notes_.all, ElementsAre("2 towns lie outside the terrain: Near, Far"));
}

TEST_F(SceneTowns, RulesBuildThem) {
  const auto resolved = [&](const std::string& text) {
    const LandCover cover = make_scene_land_cover(
        scene("[land_cover.settings]\nsettlement = -1\n" + text), plain(), notes_);
    const Grid<LandCoverClass>& cells = cover.classes.cells;
    return std::count(cells.begin(), cells.end(), LandCoverClass::settlement) * 900.0;
  };
  EXPECT_EQ(resolved(""), 0.0);
  const double circle_m2 = 3.14159 * 700.0 * 700.0;
  EXPECT_NEAR(resolved("[[land_cover.towns]]\nposition = [683000, 5237000]\nradius_m = 700\n"),
              circle_m2, 0.3 * circle_m2);
}

TEST_F(SceneTowns, ThatRastersLeaveNoUseForAreNoted) {
  write_raster(folder_ / "cover.tif", Raster<float>{Grid<float>(50, 50, 10.F),
                                                    {680000.0, 5240000.0, 120.0, 120.0},
                                                    normalize_crs("EPSG:32632")});
  const std::string cover =
      "legend = \"esa_worldcover\"\n[[land_cover.sources]]\nfile = \"cover.tif\"\n";
  const std::string town = "[[land_cover.towns]]\nposition = [683000, 5237000]\nradius_m = 700\n";
  make_scene_land_cover(scene("[land_cover]\n" + cover + town), plain(), notes_);
  EXPECT_THAT(notes_.all, ElementsAre(HasSubstr("towns are not used")));
  notes_.all.clear();
  make_scene_land_cover(
      scene("[land_cover]\nrefine = { settlement = \"forest\" }\n" + cover + town), plain(),
      notes_);
  EXPECT_THAT(notes_.all, Not(Contains(HasSubstr("towns are not used"))));
}

TEST_F(SceneTowns, RefuseWhatTheyDoNotUnderstand) {
  const auto refused = [&](const std::string& text) {
    return test::usage_error([&] { scene(text); });
  };
  EXPECT_THAT(refused("[[land_cover.towns]]\nradius_m = 5\n"),
              HasSubstr("land_cover.towns.0 has no position"));
  EXPECT_THAT(refused("[[land_cover.towns]]\nposition = [1, 2]\n"),
              HasSubstr("radius_m is missing"));
  EXPECT_THAT(refused("[[land_cover.towns]]\nposition = [1, 2]\nradius_m = 0\n"),
              HasSubstr("more than 0"));
  EXPECT_THAT(
      refused("[[land_cover.towns]]\nposition = [1, 2]\nposition_lonlat = [1, 2]\nradius_m = 9\n"),
      HasSubstr("exclude"));
  // As towns were written before.
  EXPECT_THAT(refused("[land_cover.settings]\ntreeline_m = 1\ntown_12_radius_m = 900\n"),
              AllOf(HasSubstr("s.toml:4:"), HasSubstr("town_12_radius_m"),
                    HasSubstr("[[land_cover.towns]]")));
  EXPECT_NO_THROW(scene("[land_cover.settings]\ntown_highest_m = 900\n"));
  // A file that is not there is named before anything is read.
  EXPECT_THAT(test::input_error(
                  [&] { require_scene_files(scene("[land_cover]\ntowns_file = \"none.csv\"\n")); }),
              HasSubstr("land_cover.towns_file"));
  // Degrees need a CRS.
  Dem bare = plain();
  bare.crs.clear();
  const LoadedScene degrees =
      scene("[[land_cover.towns]]\nposition_lonlat = [11.4, 47.2]\nradius_m = 9\n");
  EXPECT_THAT(test::usage_error([&] { make_scene_towns(degrees, bare, notes_); }),
              HasSubstr("land_cover.towns.0.position_lonlat"));
}

}  // namespace
}  // namespace belvedere
