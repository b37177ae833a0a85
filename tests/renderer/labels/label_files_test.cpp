#include "renderer/labels/label_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "terrain/io/crs.h"
#include "tests/files.h"

namespace belvedere {
namespace {

using testing::HasSubstr;
using testing::Not;

LabelSheet one_label(const std::string& name) {
  const LabelPoint point{.name = name,
                         .altitude_m = 2749.0,
                         .position = {680000.0, 5250000.0},
                         .where = "peaks.csv:2"};
  LabelMark mark;
  mark.drawn_position = {680100.0, 5250000.0};
  mark.dem_altitude_m = 2731.25;
  mark.pixel = {1000.0, 400.0};
  mark.distance_m = 31234.5;
  mark.state = MarkState::seen;
  return make_labels({point}, {mark}, std::vector<double>(2000, 0.0), load_label_style("classic"),
                     {2000, 800}, 1000.0);
}

TEST(LabelFiles, SvgIsTheSheetInMillimetresWithTextAsText) {
  const LabelSheet sheet = one_label("Birkkarspitze");
  const std::string svg = labels_svg(sheet, "pictures/a&b.png");
  EXPECT_THAT(svg, HasSubstr(R"(width="1000.000mm" height="400.000mm" viewBox="0 0 2000 800")"));
  EXPECT_THAT(svg, HasSubstr("xlink:href=\"pictures/a&amp;b.png\""));
  EXPECT_THAT(svg, HasSubstr(">Birkkarspitze"));
  EXPECT_THAT(svg, HasSubstr("text-anchor=\"middle\""));
  const LabelBox& box = sheet.labels[0].spot.text;
  EXPECT_THAT(svg, HasSubstr("<text x=\"1000.00\"")) << .5 * (box.left + box.right);
  EXPECT_THAT(labels_svg(sheet), Not(HasSubstr("<image")));
}

TEST(LabelFiles, SvgHoldsNamesThatLookLikeMarkup) {
  const std::string svg = labels_svg(one_label("<b> & \"Co\"\x01"));
  EXPECT_THAT(svg, HasSubstr("&lt;b&gt; &amp; &quot;Co&quot; "));
  EXPECT_THAT(svg, Not(HasSubstr("<b>")));
}

TEST(LabelFiles, TheTableHasEveryPoint) {
  LabelSheet sheet = one_label("A; \"B\"");
  sheet.labels.push_back(sheet.labels[0]);
  sheet.labels[1].point.name = "C";
  sheet.labels[1].mark.state = MarkState::outside_terrain;
  sheet.labels[1].mark.dem_altitude_m = NAN;
  const std::string csv = labels_csv(sheet);
  EXPECT_THAT(csv, HasSubstr("\"A; "
                             "\"\"B\"\"\",summit,5,placed,1000.00,400.00,31234,2749.0,2731.2,"
                             "680000.00,5250000.00,680100.00,5250000.00,,peaks.csv:2\n"));
  EXPECT_THAT(csv, HasSubstr("C,summit,5,outside the terrain,,,,2749.0,,"));
}

TEST(LabelFiles, GeoJsonSpeaksLongitudeAndLatitude) {
  const std::string json = labels_geojson(one_label("A"), normalize_crs("EPSG:32632"));
  const glm::dvec2 position = transform_point("EPSG:32632", "EPSG:4326", {680100.0, 5250000.0});
  char text[64];
  std::snprintf(text, sizeof text, "%.7f", position.x);
  EXPECT_THAT(json, HasSubstr(text));
  EXPECT_THAT(json, HasSubstr("\"outcome\": \"placed\""));
  EXPECT_THAT(test::usage_error([] { labels_geojson(one_label("A"), ""); }), HasSubstr("no CRS"));
}

}  // namespace
}  // namespace belvedere
