#include "terrain/io/lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "terrain/io/crs.h"
#include "tests/terrain/io/raster_files.h"

namespace belvedere {
namespace {

using test::message_of;
using testing::HasSubstr;

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
  EXPECT_THAT(message_of(ErrorKind::usage, [&] { read_lines(path("tour.kml"), utm_); }),
              HasSubstr(".gpx"));
  EXPECT_THAT(message_of(ErrorKind::input, [&] { read_lines(path("none.gpx"), utm_); }),
              HasSubstr("file not found"));
  EXPECT_THAT(
      message_of(ErrorKind::input, [&] { read_lines(write_text("bad.gpx", "<gpx"), utm_); }),
      HasSubstr("bad.gpx"));
  const std::string point =
      R"({"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [11, 47]}})";
  EXPECT_THAT(
      message_of(ErrorKind::input, [&] { read_lines(write_text("point.geojson", point), utm_); }),
      HasSubstr("no line"));
  EXPECT_THAT(message_of(ErrorKind::usage, [&] { read_lines(write_text("a.geojson", point), ""); }),
              HasSubstr("no CRS"));
}

}  // namespace
}  // namespace belvedere
