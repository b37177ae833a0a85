// `belvedere features check` as users meet it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "terrain/io/raster_io.h"
#include "tests/tools/program.h"

namespace belvedere {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// A wall of 900 m across level ground, seen from the south.
class FeaturesCheckCommand : public Program {
 protected:
  void SetUp() override {
    Raster<float> raster{Grid<float>(100, 120, 500.F),
                         {680000.0, 5252000.0, 100.0, 100.0},
                         normalize_crs("EPSG:32632")};
    for (int x = 0; x < 100; ++x)
      for (int y = 50; y < 54; ++y) raster.cells(x, y) = 1400.F;
    write_raster(path("wall.tif"), raster);
    scene("kind_of = \"kind\"");
  }
  void scene(const std::string& how) const {
    write("scene.toml", R"(version = 1
[[terrain.sources]]
file = "wall.tif"
[camera]
position = [685000, 5234000]
height_m = 3500
azimuth_deg = 0
pitch_deg = -18
[deform]
exaggeration = 1
[deform.bend]
radius_m = 0
[output]
width = 800
height = 500
sheet_width_mm = 400
[[features]]
source = "roads.geojson"
)" + how + "\n");
  }
  static std::string line(const std::string& kind, const std::string& positions) {
    return "{\"type\": \"Feature\", \"properties\": {\"kind\": \"" + kind +
           "\"}, \"geometry\": {\"type\": \"LineString\", \"coordinates\": [" + positions + "]}}";
  }
  void roads(const std::string& features) const {
    write("roads.geojson",
          "{\"type\": \"FeatureCollection\", \"crs\": {\"type\": \"name\", \"properties\": "
          "{\"name\": \"EPSG:32632\"}}, \"features\": [" +
              features + "]}");
  }
  Outcome check(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"features", "check", path("scene.toml"), "--quiet"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

TEST_F(FeaturesCheckCommand, SaysWhatBecomesOfEachKindAndWhy) {
  roads(line("road", "[684000, 5244000], [686000, 5244000]") + "," +
        line("road", "[684000, 5247500], [686000, 5247500]") + "," +
        line("lake", "[684000, 5244000], [686000, 5244000]") + "," +
        line("runway", "[684000, 5244000], [686000, 5244000]") + "," +
        line("path", "[680200, 5240100], [680300, 5240100]"));
  const Outcome outcome = check();
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(
      outcome.out,
      AllOf(HasSubstr("roads.geojson: 5 features read"),
            HasSubstr("1 drawn, 1 hidden by ground; 4.0 km, 2.0 km of them visible"),
            HasSubstr("1 left out: of a geometry type"),
            HasSubstr("the style has no kind \"runway\""), HasSubstr("1 outside the picture")));
  ASSERT_THAT(check({"--json"}),
              Prints(AllOf(HasSubstr("\"hidden\": 1"), HasSubstr("\"unknown\": {"),
                           HasSubstr("\"runway\": 1"))));
}

TEST_F(FeaturesCheckCommand, AWrongSystemIsAnErrorWithBothExtents) {
  roads(line("road", "[484000, 5244000], [486000, 5244000]"));
  const Outcome outcome = check();
  EXPECT_NE(outcome.status, 0);
  EXPECT_THAT(outcome.out, HasSubstr("1 outside the terrain"));
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("E 484000 … 486000"), HasSubstr("E 680000 … 690000")));
}

// Also for kinds that become ground, which are not drawn.
TEST_F(FeaturesCheckCommand, AreasBesideTheTerrainAreAnErrorToo) {
  write(
      "roads.geojson",
      R"({"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:32632"}}, "features": [
{"type": "Feature", "properties": {"kind": "forest"}, "geometry": {"type": "Polygon", "coordinates": [[[84000, 5244000], [84900, 5244000], [84000, 5245000], [84000, 5244000]]]}}]})");
  const Outcome outcome = check();
  EXPECT_NE(outcome.status, 0);
  EXPECT_THAT(outcome.out, HasSubstr("part of the ground, 1 of them outside the terrain"));
  EXPECT_THAT(outcome.err, AllOf(HasSubstr("none of 1 features lies on the terrain"),
                                 HasSubstr("E 84000 … 84900")));
  // Metres that are read as degrees.
  write("roads.geojson", R"({"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"kind": "road"}, "geometry": {"type": "LineString", "coordinates": [[684000, 5244000], [686000, 5244000]]}}]})");
  EXPECT_THAT(check().err, HasSubstr("these are metres, not degrees: (684000, 5244000)"));
}

TEST_F(FeaturesCheckCommand, PointsAtZeroZeroAreOutsideTheTerrain) {
  write("roads.geojson", R"({"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"kind": "hut"}, "geometry": {"type": "Point", "coordinates": [0, 0]}}]})");
  const Outcome outcome = check();
  EXPECT_NE(outcome.status, 0);
  EXPECT_THAT(outcome.err + outcome.out, AllOf(HasSubstr("none of 1 features lies on the terrain"),
                                               Not(HasSubstr("1 drawn"))));
}

TEST_F(FeaturesCheckCommand, WhatTheSceneAsksWronglyIsSaid) {
  roads(line("road", "[684000, 5244000], [686000, 5244000]"));
  scene("kind = \"raod\"");
  EXPECT_THAT(check().err,
              AllOf(HasSubstr("features.0.kind"), HasSubstr("did you mean \"road\"?")));
  scene("kind_of = \"highway\"");
  EXPECT_THAT(check().err, HasSubstr("no column \"highway\""));
  scene("kind = \"road\"\nwhere = \"lanes > 2\"");
  EXPECT_THAT(check().err, HasSubstr("invalid filter"));
}

}  // namespace
}  // namespace belvedere
