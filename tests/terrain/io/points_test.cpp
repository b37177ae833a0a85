#include "terrain/io/points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <glm/geometric.hpp>

#include "terrain/io/crs.h"
#include "terrain/io/raster_io.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

using test::input_error;
using test::message_of;
using test::usage_error;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class Points : public RasterFiles {
 protected:
  // Two towns as a layer that ogr2ogr, an independent program, writes from GeoJSON; empty if it is
  // missing.
  std::string write_layer(const std::string& name, const std::string& options) const {
    write_text("source.geojson",
               R"({"type": "FeatureCollection", "features": [
  {"type": "Feature", "properties": {"name": "Innsbruck", "population": 132000, "note": null},
   "geometry": {"type": "Point", "coordinates": [11.3936, 47.2692]}},
  {"type": "Feature", "properties": {"name": "Hall", "population": 14000.5, "note": "salt"},
   "geometry": {"type": "Point", "coordinates": [11.5066, 47.2826]}}]})");
    const std::string command = "ogr2ogr " + options + " '" + path(name) + "' '" +
                                path("source.geojson") + "' > /dev/null 2>&1";
    return std::system(command.c_str()) == 0 ? path(name) : std::string();
  }
  static bool has_ogr2ogr() { return std::system("command -v ogr2ogr > /dev/null") == 0; }

  std::string utm_ = normalize_crs("EPSG:32632");
};

TEST_F(Points, CsvByDegreesAndByMetres) {
  const std::string degrees = write_text(
      "a.csv",
      "Name;LON;Lat;radius_m\nInnsbruck;11.3936;47.2692;2600\n\"Hall; Tirol\";11.5066;47.2826;\n");
  const PointTable table = read_points(degrees, utm_);
  EXPECT_THAT(table.columns, ElementsAre("Name", "LON", "Lat", "radius_m"));
  EXPECT_EQ(table.find("RADIUS_M"), 3);
  EXPECT_EQ(table.find("size"), -1);
  ASSERT_EQ(table.points.size(), 2U);
  EXPECT_LT(glm::length(table.points[0].position -
                        transform_point("EPSG:4326", utm_, {11.3936, 47.2692})),
            1e-3);
  EXPECT_THAT(table.points[1].values, ElementsAre("Hall; Tirol", "11.5066", "47.2826", ""));
  EXPECT_EQ(table.points[1].where, degrees + ":3");
  // Metres are those of the scene, with or without a CRS.
  const std::string metres = write_text("b.csv", "north,east\n5237500.5,681000\n");
  EXPECT_EQ(read_points(metres, "").points.at(0).position, glm::dvec2(681000.0, 5237500.5));
  EXPECT_EQ(read_points(metres, utm_).points.at(0).position, glm::dvec2(681000.0, 5237500.5));
}

TEST_F(Points, LayersAreReprojected) {
  if (!has_ogr2ogr()) GTEST_SKIP() << "needs GDAL's program ogr2ogr";
  const glm::dvec2 hall = transform_point("EPSG:4326", utm_, {11.5066, 47.2826});
  for (const char* name : {"plain.gpkg", "plain.geojson", "plain.shp", "plain.fgb"}) {
    const std::string file = write_layer(name, "-lco SPATIAL_INDEX=NO");
    ASSERT_FALSE(file.empty()) << name;
    const PointTable table = read_points(file, utm_);
    ASSERT_EQ(table.points.size(), 2U) << name;
    EXPECT_LT(glm::length(table.points[1].position - hall), 1e-3) << name;
    const int population = table.find("population");
    ASSERT_GE(population, 0) << name;
    EXPECT_EQ(std::stod(table.points[1].values[static_cast<std::size_t>(population)]), 14000.5)
        << name;
    const int note = table.find("note");
    ASSERT_GE(note, 0) << name;
    EXPECT_EQ(table.points[0].values[static_cast<std::size_t>(note)], "") << name;
  }
  // From another CRS.
  const PointTable web = read_points(write_layer("web.gpkg", "-t_srs EPSG:3857"), utm_);
  EXPECT_LT(glm::length(web.points.at(1).position - hall), 1e-2);
}

TEST_F(Points, OfSeveralLayersTheOneNamedTowns) {
  if (!has_ogr2ogr()) GTEST_SKIP() << "needs GDAL's program ogr2ogr";
  write_layer("two.gpkg", "-nln huts");
  write_layer("two.gpkg", "-update -nln summits");
  EXPECT_THAT(input_error([&] { read_points(path("two.gpkg"), utm_); }),
              AllOf(HasSubstr("huts, summits"), HasSubstr("towns")));
  write_layer("two.gpkg", "-update -nln towns -where \"name = 'Hall'\"");
  EXPECT_EQ(read_points(path("two.gpkg"), utm_).points.size(), 1U);
}

// Without a .cpg file GDAL passes bytes on; with one it converts them.
TEST_F(Points, ShapefilesInAnotherEncodingNeedItsName) {
  if (!has_ogr2ogr()) GTEST_SKIP() << "needs GDAL's program ogr2ogr";
  const std::string csv = write_text("p.csv", "name,lon,lat\nW\xc3\xb6rner,11.3,47.4\n");
  const std::string file = path("p.shp");
  ASSERT_EQ(std::system(("ogr2ogr -f 'ESRI Shapefile' -lco ENCODING=ISO-8859-1 -a_srs EPSG:4326 "
                         "-oo X_POSSIBLE_NAMES=lon -oo Y_POSSIBLE_NAMES=lat " +
                         file + " " + csv)
                            .c_str()),
            0);
  write_text("p.cpg", "ISO-8859-1");
  EXPECT_EQ(read_points(file, utm_).points.at(0).values.at(0), "W\xc3\xb6rner");
  // No .cpg, and no code page in the table's own header (byte 29).
  std::filesystem::remove(path("p.cpg"));
  std::string table = read_text("p.dbf");
  table.at(29) = '\0';
  write_text("p.dbf", table);
  EXPECT_THAT(input_error([&] { read_points(file, utm_); }),
              AllOf(HasSubstr("feature 0"), HasSubstr("p.cpg"), HasSubstr("ISO-8859-1")));
}

TEST_F(Points, RefuseWhatGivesNoPlace) {
  const auto refused = [&](const std::string& name, const std::string& text,
                           ErrorKind kind = ErrorKind::usage) {
    const std::string file = write_text(name, text);
    return message_of(kind, [&] { read_points(file, utm_); });
  };
  EXPECT_THAT(refused("a.csv", "name,x,y\nA,1,2\n"),
              AllOf(HasSubstr("a.csv:1"), HasSubstr("name, x, y"), HasSubstr("lon and lat")));
  EXPECT_THAT(refused("a.csv", "lon,lat\n11,47\n11.5,91\n"),
              AllOf(HasSubstr("a.csv:3"), HasSubstr("lat is \"91\"")));
  EXPECT_THAT(refused("a.csv", "lon;lat\n11,5;47\n"), HasSubstr("with a decimal point"));
  EXPECT_THAT(refused("a.csv", "lon,lat\n,47\n"), HasSubstr("lon is \"\""));
  EXPECT_THAT(refused("a.csv", "lon,lat\nnan,47\n"), HasSubstr("lon is \"nan\""));
  EXPECT_THAT(refused("a.xlsx", "lon,lat\n11,47\n"), HasSubstr(".gpkg"));
  EXPECT_THAT(refused("a.gpkg", "lon,lat\n11,47\n", ErrorKind::input), HasSubstr("GPKG"));
  EXPECT_THAT(refused("a.geojson", R"({"type": "LineString", "coordinates": [[11, 47], [12, 48]]})",
                      ErrorKind::input),
              HasSubstr("no point layer"));
  EXPECT_THAT(input_error([&] { read_points(path("none.gpkg"), utm_); }),
              HasSubstr("file not found"));
  EXPECT_THAT(refused("a.geojson", R"({"type": "Point", "coordinates": [1273000, 6020000]})",
                      ErrorKind::input),
              AllOf(HasSubstr("a.geojson, feature 0: these are metres, not degrees"),
                    HasSubstr("EPSG:3857")));
  const std::string degrees = write_text("b.csv", "lon,lat\n11,47\n");
  EXPECT_THAT(usage_error([&] { read_points(degrees, ""); }), HasSubstr("terrain has no CRS"));
}

// A file must not refer to others: a virtual layer under a harmless name is rejected.
TEST_F(Points, OnlyTheFormatThatTheEndingNames) {
  write_text("secret.csv", "lon,lat\n11,47\n");
  const std::string virtual_layer =
      "<OGRVRTDataSource><OGRVRTLayer name=\"secret\"><SrcDataSource>" + path("secret.csv") +
      "</SrcDataSource><GeometryType>wkbPoint</GeometryType><LayerSRS>WGS84</LayerSRS>"
      "<GeometryField encoding=\"PointFromColumns\" x=\"lon\" "
      "y=\"lat\"/></OGRVRTLayer></OGRVRTDataSource>";
  for (const char* name : {"a.geojson", "a.gpkg", "a.shp", "a.fgb"}) {
    const std::string file = write_text(name, virtual_layer);
    input_error([&] { read_points(file, utm_); });
  }
}

// A scene's keys say what a file does not.
TEST_F(Points, ASourceStatesCrsAndEncoding) {
  const std::string csv =
      write_text("a.csv", "name,east,north\nW\xf6rner,4445000,5265000\n");  // Gauss-Krüger
  VectorSource source = csv;
  source.crs = "EPSG:31468";
  source.encoding = "windows-1252";
  const PointTable table = read_points(source, utm_);
  EXPECT_EQ(table.points.at(0).values.at(0), "Wörner");
  EXPECT_LT(glm::length(table.points[0].position -
                        transform_point("EPSG:31468", utm_, {4445000, 5265000})),
            1e-3);
  source.encoding = "latin-nine";
  EXPECT_THAT(usage_error([&] { read_points(source, utm_); }), HasSubstr("latin-nine"));
  if (!has_ogr2ogr()) GTEST_SKIP() << "needs GDAL's program ogr2ogr";
  write_text("umlaut.geojson",
             R"({"type": "FeatureCollection", "features": [{"type": "Feature",
  "properties": {"name": "Wörner"}, "geometry": {"type": "Point", "coordinates": [11.4, 47.3]}}]})");
  ASSERT_EQ(std::system(("ogr2ogr -lco ENCODING=ISO-8859-1 '" + path("p.shp") + "' '" +
                         path("umlaut.geojson") + "' > /dev/null 2>&1")
                            .c_str()),
            0);
  // The .dbf names its code page as well.
  std::string dbf = read_text("p.dbf");
  dbf[29] = '\0';
  write_text("p.dbf", dbf);
  std::filesystem::remove(path("p.cpg"));
  std::filesystem::remove(path("p.prj"));
  VectorSource bare = path("p.shp");
  EXPECT_THAT(input_error([&] { read_points(bare, utm_); }), HasSubstr("`crs`"));
  bare.crs = "EPSG:4326";
  EXPECT_THAT(input_error([&] { read_points(bare, utm_); }), HasSubstr("`encoding`"));
  bare.encoding = "ISO-8859-1";
  const PointTable read = read_points(bare, utm_);
  EXPECT_EQ(read.points.at(0).values.at(0), "Wörner");
  EXPECT_LT(glm::length(read.points[0].position - transform_point("EPSG:4326", utm_, {11.4, 47.3})),
            1e-3);
  VectorSource utf8 = path("umlaut.geojson");
  utf8.encoding = "ISO-8859-1";
  EXPECT_THAT(usage_error([&] { read_points(utf8, utm_); }), HasSubstr("always UTF-8"));
}

class Lines : public RasterFiles {
 protected:
  std::string utm_ = normalize_crs("EPSG:32632");
};

TEST_F(Lines, OfGpxTracksAndRoutes) {
  const std::string file = write_text(
      "tour.gpx",
      R"(<?xml version="1.0"?><gpx version="1.1" creator="test" xmlns="http://www.topografix.com/GPX/1/1">
<wpt lat="47.0" lon="11.0"><name>no line</name></wpt>
<rte><name>there</name><rtept lat="47.1" lon="11.1"/><rtept lat="47.2" lon="11.2"/></rte>
<trk><name>back</name><trkseg><trkpt lat="47.2" lon="11.2"/><trkpt lat="47.1" lon="11.3"/><trkpt lat="47.0" lon="11.4"/></trkseg>
<trkseg><trkpt lat="46.9" lon="11.4"/><trkpt lat="46.8" lon="11.4"/></trkseg></trk></gpx>)");
  const std::vector<MapLine> lines = read_lines(file, utm_);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].name, "there");
  EXPECT_EQ(lines[1].name, "back");
  EXPECT_EQ(lines[1].positions.size(), 3U);
  EXPECT_EQ(lines[2].positions.size(), 2U)
      << "a segment of its own: the way is not known between them";
  EXPECT_LT(glm::length(lines[0].positions[1] - transform_point("EPSG:4326", utm_, {11.2, 47.2})),
            1e-3);
}

TEST_F(Lines, OfGeoJson) {
  const std::string file = write_text("ways.geojson", R"({"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"name": "A"}, "geometry": {"type": "MultiLineString", "coordinates": [[[11, 47], [11.1, 47]], [[11.2, 47], [11.3, 47], [11.4, 47]]]}},
{"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [11, 47]}}]})");
  const std::vector<MapLine> lines = read_lines(file, utm_);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[1].name, "A");
  EXPECT_EQ(lines[1].positions.size(), 3U);
}

TEST_F(Lines, WrongFilesAreSaid) {
  EXPECT_THAT(usage_error([&] { read_lines(path("tour.kml"), utm_); }), HasSubstr(".gpx"));
  EXPECT_THAT(input_error([&] { read_lines(path("none.gpx"), utm_); }),
              HasSubstr("file not found"));
  EXPECT_THAT(input_error([&] { read_lines(write_text("bad.gpx", "<gpx"), utm_); }),
              HasSubstr("bad.gpx"));
  const std::string point =
      R"({"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [11, 47]}})";
  EXPECT_THAT(input_error([&] { read_lines(write_text("point.geojson", point), utm_); }),
              HasSubstr("no line"));
  EXPECT_THAT(usage_error([&] { read_lines(write_text("a.geojson", point), ""); }),
              HasSubstr("no CRS"));
}

}  // namespace
}  // namespace belvedere
