#include "terrain/io/features.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <glm/geometric.hpp>

#include "terrain/io/crs.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

using test::input_error;
using test::message_of;
using test::usage_error;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class MapFeatureFiles : public RasterFiles {
 protected:
  std::string mixed() const {
    return write_text("mixed.geojson", R"({"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"kind": "road", "width": 7.5}, "geometry": {"type": "MultiLineString", "coordinates": [[[11, 47], [11.1, 47]], [[11.2, 47], [11.3, 47], [11.4, 47]]]}},
{"type": "Feature", "properties": {"kind": "lake"}, "geometry": {"type": "Polygon", "coordinates": [[[11, 47], [11.1, 47], [11.1, 47.1], [11, 47]], [[11.05, 47.01], [11.06, 47.01], [11.06, 47.02], [11.05, 47.01]]]}},
{"type": "Feature", "properties": {"kind": "hut"}, "geometry": {"type": "Point", "coordinates": [11, 47]}},
{"type": "Feature", "properties": {"kind": "nothing"}, "geometry": null},
{"type": "Feature", "properties": {"kind": "short"}, "geometry": {"type": "LineString", "coordinates": [[11, 47], [11, 47]]}}]})");
  }
  std::string utm_ = normalize_crs("EPSG:32632");
};

TEST_F(MapFeatureFiles, PointsLinesAndAreasWithWhatIsSaidOfThem) {
  const MapFeatures read =
      read_map_features(mixed(), {.layer = {}, .where = {}, .columns = {"KIND", "width"}}, utm_);
  EXPECT_EQ(read.read, 5U);
  EXPECT_EQ(read.without_shape, 2U) << "no geometry, and a line of one place";
  ASSERT_EQ(read.features.size(), 4U) << "two parts of a line are two lines";
  EXPECT_EQ(read.features[0].shape, MapShape::line);
  EXPECT_THAT(read.features[0].values, ElementsAre("road", "7.5"));
  EXPECT_EQ(read.features[1].parts[0].size(), 3U);
  EXPECT_THAT(read.features[1].where, HasSubstr("mixed.geojson"));
  EXPECT_EQ(read.features[2].shape, MapShape::area);
  ASSERT_EQ(read.features[2].parts.size(), 2U) << "outline and hole";
  EXPECT_EQ(read.features[2].parts[0].size(), 3U) << "without the closing place";
  EXPECT_THAT(read.features[2].values, ElementsAre("lake", ""));
  EXPECT_EQ(read.features[3].shape, MapShape::point);
  EXPECT_LT(
      glm::length(read.features[3].parts[0][0] - transform_point("EPSG:4326", utm_, {11.0, 47.0})),
      1e-3);
}

TEST_F(MapFeatureFiles, OnlyWhatTheFilterAsksFor) {
  const MapFeatures read = read_map_features(
      mixed(), {.layer = {}, .where = "kind = 'road' AND width > 5", .columns = {}}, utm_);
  EXPECT_EQ(read.read, 1U);
  EXPECT_EQ(read.features.size(), 2U);
  EXPECT_TRUE(
      read_map_features(mixed(), {.layer = {}, .where = "kind = 'sea'", .columns = {}}, utm_)
          .features.empty());
}

TEST_F(MapFeatureFiles, TracksOfGpxAndNotTheirPlacesOnceMore) {
  const std::string file = write_text(
      "tour.gpx",
      R"(<?xml version="1.0"?><gpx version="1.1" creator="test" xmlns="http://www.topografix.com/GPX/1/1">
<wpt lat="47.0" lon="11.0"><name>hut</name></wpt>
<trk><name>back</name><trkseg><trkpt lat="47.2" lon="11.2"/><trkpt lat="47.1" lon="11.3"/><trkpt lat="47.0" lon="11.4"/></trkseg></trk></gpx>)");
  const MapFeatures read = read_map_features(file, {}, utm_);
  ASSERT_EQ(read.features.size(), 2U);
  EXPECT_EQ(read.features[0].shape, MapShape::point);
  EXPECT_EQ(read.features[1].parts[0].size(), 3U);
  EXPECT_EQ(read_map_features(file, {.layer = "track_points", .where = {}, .columns = {}}, utm_)
                .features.size(),
            3U)
      << "where asked for";
}

// Loggers that open a segment for each point still describe one track.
TEST_F(MapFeatureFiles, SegmentsOfOnePointAreOneLine) {
  std::string segments;
  for (int i = 0; i < 5; ++i)
    segments += "<trkseg><trkpt lat=\"47." + std::to_string(i) + "\" lon=\"11.0\"/></trkseg>";
  const std::string head =
      R"(<?xml version="1.0"?><gpx version="1.1" creator="t" xmlns="http://www.topografix.com/GPX/1/1"><trk>)";
  const MapFeatures read =
      read_map_features(write_text("log.gpx", head + segments + "</trk></gpx>"), {}, utm_);
  ASSERT_EQ(read.features.size(), 1U);
  EXPECT_EQ(read.features[0].shape, MapShape::line);
  ASSERT_EQ(read.features[0].parts.size(), 1U);
  EXPECT_EQ(read.features[0].parts[0].size(), 5U);
  EXPECT_NEAR(glm::length(read.features[0].parts[0].front() - read.features[0].parts[0].back()),
              44480.0, 60.0)
      << "0.4 degrees of latitude";
  // One point alone is no line.
  EXPECT_TRUE(read_map_features(
                  write_text("one.gpx", head + segments.substr(0, segments.find("<trkseg>", 1)) +
                                            "</trk></gpx>"),
                  {}, utm_)
                  .features.empty());
}

TEST_F(MapFeatureFiles, ArchivesAreToBeUnpacked) {
  EXPECT_THAT(input_error([&] { read_map_features(write_text("a.zip", "PK\x03\x04"), {}, utm_); }),
              AllOf(HasSubstr("zip archive"), HasSubstr("unpack")));
}

TEST_F(MapFeatureFiles, PlacesThatTheSystemDoesNotHaveAreCountedAndTheirFeaturesLeftOutWhole) {
  const std::string file =
      write_text("poles.geojson", R"({"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[11, 47], [11, 5000]]}},
{"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[11, 47], [11, 48]]}}]})");
  const MapFeatures read = read_map_features(file, {}, utm_);
  EXPECT_EQ(read.unplaceable, 1U);
  EXPECT_EQ(read.features.size(), 1U);
}

TEST_F(MapFeatureFiles, WhatLiesBesideTheBoxIsCountedAndLetGo) {
  const std::string file = mixed();
  const glm::dvec2 low = transform_point("EPSG:4326", utm_, {11.15, 46.9});
  const glm::dvec2 high = transform_point("EPSG:4326", utm_, {11.5, 47.2});
  const MapFeatures read = read_map_features(file, {.box = MapBox{low, high}}, utm_);
  EXPECT_EQ(read.read, 5U);
  ASSERT_EQ(read.features.size(), 1U) << "the second part of the road";
  EXPECT_EQ(read.features[0].parts[0].size(), 3U);
  EXPECT_EQ(read.beside, 3U);
  EXPECT_LT(read.extent.low.x, low.x) << "of all, beside the box as well";
  // A line that only passes through the box lies in it.
  const std::string through =
      write_text("through.geojson", R"({"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[10, 47], [12, 47]]}}]})");
  EXPECT_EQ(read_map_features(through, {.box = MapBox{low, high}}, utm_).features.size(), 1U);
}

TEST_F(MapFeatureFiles, PlacesAtZeroAreNobodysPlaces) {
  const std::string file = write_text("zero.geojson", R"({"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [0, 0]}},
{"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [9, 0]}}]})");
  const MapFeatures read = read_map_features(file, {}, utm_);
  EXPECT_EQ(read.at_zero, 1U);
  EXPECT_EQ(read.features.size(), 2U) << "they lie where they say";
}

// Every position counts, those of the first and of the last feature as well; areas without the
// closing one, and nothing beside the box.
TEST_F(MapFeatureFiles, MorePositionsThanTheLimitAreRefused) {
  const std::string file = mixed();  // lines of 2 and 3, an area of 3 and 3, a point
  EXPECT_EQ(read_map_features(file, {.max_positions = 12}, utm_).features.size(), 4U);
  EXPECT_THAT(
      message_of(ErrorKind::limit, [&] { read_map_features(file, {.max_positions = 11}, utm_); }),
      AllOf(HasSubstr("mixed.geojson"), HasSubstr("more than 11 positions")));
  const glm::dvec2 low = transform_point("EPSG:4326", utm_, {11.15, 46.9});
  const glm::dvec2 high = transform_point("EPSG:4326", utm_, {11.5, 47.2});
  EXPECT_EQ(
      read_map_features(file, {.box = MapBox{low, high}, .max_positions = 3}, utm_).features.size(),
      1U);
}

TEST_F(MapFeatureFiles, OpenStreetMapsOwnFormat) {
  const std::string file =
      write_text("region.osm", R"(<?xml version="1.0" encoding="UTF-8"?><osm version="0.6">
<node id="1" lat="47.0" lon="11.0" version="1"/><node id="2" lat="47.0" lon="11.1" version="1"/><node id="3" lat="47.1" lon="11.1" version="1"/>
<node id="4" lat="47.05" lon="11.05" version="1"><tag k="place" v="village"/><tag k="name" v="Dorf"/></node>
<way id="10" version="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><tag k="waterway" v="river"/><tag k="name" v="Ache"/></way>
<way id="11" version="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/><tag k="natural" v="water"/></way>
</osm>)");
  const MapFeatures rivers =
      read_map_features(file, {.where = "waterway = 'river'", .columns = {"waterway"}}, utm_);
  ASSERT_EQ(rivers.features.size(), 1U);
  EXPECT_EQ(rivers.features[0].shape, MapShape::line);
  EXPECT_THAT(rivers.features[0].values, ElementsAre("river"));
  const MapFeatures waters =
      read_map_features(file, {.layer = "multipolygons", .columns = {"natural"}}, utm_);
  ASSERT_EQ(waters.features.size(), 1U);
  EXPECT_EQ(waters.features[0].shape, MapShape::area);
  EXPECT_THAT(waters.features[0].values, ElementsAre("water"));
  EXPECT_EQ(read_map_features(file, {}, utm_).features.size(), 3U) << "layers that the file mixes";
  EXPECT_THAT(input_error([&] {
                read_map_features(write_text("broken.osm.pbf", "no such thing"), {}, utm_);
              }),
              HasSubstr("broken.osm.pbf"));
}

// The same region as XML and as PBF, converted by another program.
TEST_F(MapFeatureFiles, OpenStreetMapsBinaryFormatHoldsTheSame) {
  if (std::system("command -v osmium > /dev/null") != 0)
    GTEST_SKIP() << "needs the program osmium (osmium-tool)";
  const std::string xml = write_text(
      "country.osm", R"(<?xml version="1.0" encoding="UTF-8"?><osm version="0.6" generator="test">
<node id="1" lat="47.0" lon="11.0" version="1"/><node id="2" lat="47.0" lon="11.1" version="1"/><node id="3" lat="47.1" lon="11.1" version="1"/>
<node id="4" lat="47.05" lon="11.05" version="1"><tag k="place" v="village"/><tag k="name" v="Dorf"/><tag k="population" v="812"/></node>
<node id="5" lat="47.04" lon="11.07" version="1"/><node id="6" lat="47.04" lon="11.08" version="1"/><node id="7" lat="47.05" lon="11.08" version="1"/>
<way id="10" version="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><tag k="waterway" v="river"/><tag k="name" v="Ache"/></way>
<way id="11" version="1"><nd ref="1"/><nd ref="2"/><nd ref="3"/><nd ref="1"/></way>
<way id="12" version="1"><nd ref="5"/><nd ref="6"/><nd ref="7"/><nd ref="5"/></way>
<way id="13" version="1"><nd ref="3"/><nd ref="4"/><tag k="highway" v="primary"/></way>
<relation id="20" version="1"><member type="way" ref="11" role="outer"/><member type="way" ref="12" role="inner"/>
<tag k="type" v="multipolygon"/><tag k="natural" v="wood"/></relation>
</osm>)");
  const std::string pbf = (std::filesystem::path(xml).parent_path() / "country.osm.pbf").string();
  ASSERT_EQ(std::system(
                ("osmium cat --overwrite -o '" + pbf + "' '" + xml + "' > /dev/null 2>&1").c_str()),
            0);
  const MapFeatures woods = read_map_features(
      pbf, {.layer = "multipolygons", .where = "natural = 'wood'", .columns = {"natural"}}, utm_);
  ASSERT_EQ(woods.features.size(), 1U);
  EXPECT_EQ(woods.features[0].parts.size(), 2U) << "a clearing in the wood";
  const MapFeatures one = read_map_features(xml, {.columns = {"name", "highway"}}, utm_);
  const MapFeatures other = read_map_features(pbf, {.columns = {"name", "highway"}}, utm_);
  EXPECT_EQ(one.read, 4U);
  ASSERT_EQ(other.features.size(), one.features.size());
  for (std::size_t i = 0; i < one.features.size(); ++i) {
    EXPECT_EQ(other.features[i].shape, one.features[i].shape);
    EXPECT_EQ(other.features[i].values, one.features[i].values);
    ASSERT_EQ(other.features[i].parts.size(), one.features[i].parts.size());
    for (std::size_t k = 0; k < one.features[i].parts.size(); ++k) {
      ASSERT_EQ(other.features[i].parts[k].size(), one.features[i].parts[k].size());
      for (std::size_t n = 0; n < one.features[i].parts[k].size(); ++n)
        EXPECT_LT(glm::length(other.features[i].parts[k][n] - one.features[i].parts[k][n]), 0.02)
            << "PBF counts in 1e-7 degrees";
    }
  }
}

// One object a line, as GDAL's GeoJSONSeq, with separators (RFC 8142) or without, whatever the
// extension; the same features as of one collection.
TEST_F(MapFeatureFiles, GeoJsonMayHaveOneFeatureALine) {
  const std::string a =
      R"({"type":"Feature","properties":{"name":"A"},"geometry":{"type":"Point","coordinates":[11,47]}})";
  const std::string b =
      R"({"type":"Feature","properties":{"name":"Ö"},"geometry":{"type":"LineString","coordinates":[[11,47],[12,47]]}})";
  const std::string whole = R"({"type":"FeatureCollection","features":[)" + a + "," + b + "]}";
  for (const auto& [name, text] : std::vector<std::pair<std::string, std::string>>{
           {"a.geojson", whole},
           {"b.geojson", a + "\n" + b + "\n"},
           {"c.geojsonl", a + "\r\n" + b},
           {"d.ndjson", "\n" + a + "\n\n" + b + "\n"},
           {"e.geojsons", "\x1e" + a + "\n\x1e" + b + "\n"},
           {"f.json", "\xef\xbb\xbf" + a + "\n" + b + "\n"},
           {"g.geojson", "\xef\xbb\xbf" + whole}}) {
    const MapFeatures read = read_map_features(write_text(name, text), {.columns = {"name"}}, utm_);
    ASSERT_EQ(read.features.size(), 2U) << name;
    EXPECT_THAT(read.features[0].values, ElementsAre("A")) << name;
    EXPECT_THAT(read.features[1].values, ElementsAre("Ö")) << name;
  }
  const auto refused = [&](const std::string& name, const std::string& text,
                           ErrorKind kind = ErrorKind::input) {
    const std::string file = write_text(name, text);
    return message_of(kind, [&] { read_map_features(file, {.columns = {"name"}}, utm_); });
  };
  EXPECT_THAT(refused("h.geojsonl", a + "\n" + b.substr(0, 60) + "\n" + a + "\n"),
              HasSubstr("JSON parsing error"));
  EXPECT_THAT(refused("i.geojson", whole + "\n" + whole + "\n"), HasSubstr("jq -c"));
  // Texts of other encodings.
  EXPECT_THAT(refused("j.geojson",
                      whole.substr(0, whole.find("Ö")) + "\xd6" + whole.substr(whole.find("Ö") + 2),
                      ErrorKind::input),
              AllOf(HasSubstr("j.geojson:1:"), HasSubstr("0xD6"), HasSubstr("WINDOWS-1252")));
  std::string wide = "\xff\xfe";
  for (const char c : a) wide += {c, '\0'};
  EXPECT_THAT(refused("k.geojson", wide, ErrorKind::input), HasSubstr("UTF-16LE"));
}

// Metres in a GeoJSON that names no system. Which system they may be in follows from the terrain's.
TEST_F(MapFeatureFiles, MetresReadAsDegreesAreRefused) {
  const auto refused = [&](const std::string& positions, const std::string& crs = "EPSG:32632") {
    const std::string file = write_text(
        "m.geojson", R"({"type":"Feature","properties":{},"geometry":{"type":"LineString",)"
                     R"("coordinates":[)" +
                         positions + "]}}");
    return input_error([&] { read_map_features(file, {}, normalize_crs(crs)); });
  };
  const std::string mercator = "[1278000,5990000],[1279000,5991000]";
  EXPECT_THAT(
      refused(mercator),
      AllOf(HasSubstr("these are metres, not degrees: (1278000, 5990000) is no longitude"),
            HasSubstr("they may be in EPSG:3857"), HasSubstr("-s_srs EPSG:3857 -t_srs EPSG:4326")));
  EXPECT_THAT(refused(mercator, "EPSG:4326"), HasSubstr("(1278000, 5990000)"));
  EXPECT_THAT(refused("[685000,5252000],[685100,5252000]"), HasSubstr("EPSG:32632"));
  EXPECT_THAT(refused("[2600000,1200000],[2600000,1200100]", "EPSG:2056"),
              AllOf(HasSubstr("they may be in EPSG:2056\n"), HasSubstr("crs = \"EPSG:2056\"")));
  // The key `crs` of the scene says it.
  VectorSource source = path("m.geojson");
  source.crs = "EPSG:2056";
  EXPECT_EQ(read_map_features(source, {}, utm_).features.size(), 1U);
  // Single wrong positions leave the others.
  write_text("n.geojson", R"({"type":"GeometryCollection","geometries":[)"
                          R"({"type":"LineString","coordinates":[[11,47],[12,47],[12,48]]},)"
                          R"({"type":"LineString","coordinates":[[11,47],[1279000,5991000]]}]})");
  const MapFeatures read = read_map_features(path("n.geojson"), {}, utm_);
  EXPECT_EQ(read.features.size(), 1U);
  EXPECT_EQ(read.unplaceable, 1U);
}

TEST_F(MapFeatureFiles, WhatIsWrongIsSaid) {
  const auto message = [&](ErrorKind kind, const std::string& file, const MapQuery& query) {
    return message_of(kind, [&] { read_map_features(file, query, utm_); });
  };
  const std::string file = mixed();
  EXPECT_THAT(message(ErrorKind::usage, path("roads.kml"), {}), HasSubstr(".gpkg"));
  EXPECT_THAT(message(ErrorKind::input, path("none.gpkg"), {}), HasSubstr("file not found"));
  EXPECT_THAT(message(ErrorKind::input, write_text("broken.geojson", "{\"type\": "), {}),
              HasSubstr("broken.geojson"));
  EXPECT_THAT(message(ErrorKind::usage, file, {.layer = "roads", .where = {}, .columns = {}}),
              AllOf(HasSubstr("\"roads\""), HasSubstr("mixed")));
  EXPECT_THAT(message(ErrorKind::usage, file, {.layer = {}, .where = {}, .columns = {"highway"}}),
              AllOf(HasSubstr("\"highway\""), HasSubstr("kind, width")));
  EXPECT_THAT(
      message(ErrorKind::usage, file, {.layer = {}, .where = "kind == = 'x'", .columns = {}}),
      HasSubstr("invalid filter"));
  EXPECT_THAT(
      message(ErrorKind::usage, file, {.layer = {}, .where = "highway = 'x'", .columns = {}}),
      HasSubstr("invalid filter"));
  EXPECT_THAT(usage_error([&] { read_map_features(file, {}, ""); }), HasSubstr("no CRS"));
}

}  // namespace
}  // namespace belvedere
