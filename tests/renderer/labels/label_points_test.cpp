#include "renderer/labels/label_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/progress.h"
#include "tests/files.h"
#include "tests/notes.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

class LabelPoints : public testing::Test {
 protected:
  std::vector<LabelPoint> read(const std::string& text) {
    return read_label_points(folder_.write("points.csv", text), "", style_, progress_);
  }
  test::Folder folder_;
  LabelStyle style_ = load_label_style("classic");
  test::Notes progress_;
};

TEST_F(LabelPoints, SayNameKindRankAndAltitude) {
  const std::vector<LabelPoint> points =
      read("name,kind,rank,ele,east,north\nA,summit,1,2749.4,10,20\n\"B, C\",hut,,,30,40\n");
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].name, "A");
  EXPECT_EQ(points[0].rank, 1.0);
  EXPECT_EQ(points[0].altitude_m, 2749.4);
  EXPECT_EQ(points[0].position, glm::dvec2(10, 20));
  EXPECT_EQ(points[1].name, "B, C");
  EXPECT_EQ(style_.kinds[static_cast<std::size_t>(points[1].kind)].name, "hut");
  EXPECT_EQ(points[1].rank, 5.0);
  EXPECT_FALSE(points[1].altitude_m);
}

TEST_F(LabelPoints, OfOpenStreetMapsColumns) {
  const std::vector<LabelPoint> points =
      read("name,natural,elevation,east,north\nA,peak,2000,10,20\nB,saddle,,30,40\n");
  EXPECT_EQ(points[0].kind, style_.find("summit"));
  EXPECT_EQ(points[1].kind, style_.find("pass"));
  EXPECT_EQ(points[0].altitude_m, 2000.0);
}

TEST_F(LabelPoints, HaveTheRankOfTheirPeopleWhereNoneIsGiven) {
  const std::vector<LabelPoint> points = read(
      "name,rank,population,east,north\nA,,130000,1,2\nB,,3000,1,2\nC,2,10,1,2\nD,,,1,2\n"
      "E,,many,1,2\nF,,4,1,2\n");
  const double ranks[] = {1.0, 4.0, 2.0, 5.0, 5.0, 9.0};
  ASSERT_EQ(points.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(points[i].rank, ranks[i]) << points[i].name;
}

TEST_F(LabelPoints, WithoutANameOrWithTooLongAOneAreLeftOutAndSaid) {
  const std::string ninety(90, 'x');
  const std::vector<LabelPoint> points = read("name,east,north\n,1,2\n" + ninety + ",3,4\nA,5,6\n");
  ASSERT_EQ(points.size(), 1U);
  EXPECT_THAT(progress_.text(), HasSubstr("1 of 3 points have no name"));
  EXPECT_THAT(progress_.text(), HasSubstr("1 names of more than 80 letters"));
}

TEST_F(LabelPoints, LettersAreCountedAndNotBytes) {
  std::string eighty;
  for (int i = 0; i < 80; ++i) eighty += "ü";
  EXPECT_EQ(read("name,east,north\n" + eighty + ",1,2\n").size(), 1U);
}

TEST_F(LabelPoints, StrangeKindsAreSaidAndSetAsTheFirst) {
  const std::vector<LabelPoint> points = read("name,kind,east,north\nA,spaceport,1,2\n");
  EXPECT_EQ(points[0].kind, 0);
  EXPECT_THAT(progress_.text(), HasSubstr("spaceport"));
}

TEST_F(LabelPoints, WrongNumbersAreRefused) {
  const auto message = [&](const std::string& text) {
    return test::message_of(ErrorKind::usage, [&] { read(text); });
  };
  EXPECT_THAT(message("name,rank,east,north\nA,first,1,2\n"), HasSubstr("points.csv:2"));
  EXPECT_THAT(message("name,rank,east,north\nA,12,1,2\n"), HasSubstr("1 … 9"));
  EXPECT_THAT(message("title,east,north\nA,1,2\n"), HasSubstr("no column of names"));
}

TEST_F(LabelPoints, NamesThatAreNoTextAndFilesWithoutAnyAreRefused) {
  EXPECT_THAT(
      test::message_of(ErrorKind::input, [&] { read("name,east,north\nA,1,2\n\xD6tztal,1,2\n"); }),
      testing::AllOf(HasSubstr("points.csv:3"), HasSubstr("UTF-8")));
  for (const char* bad : {"\xC0\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE2\x82", "\x80"})
    EXPECT_THAT(test::message_of(ErrorKind::input,
                                 [&] { read(std::string("name,east,north\n") + bad + ",1,2\n"); }),
                HasSubstr("UTF-8"));
  EXPECT_EQ(read("name,east,north\nÖtztal 御嶽山 𝄞,1,2\n").size(), 1U);
  EXPECT_THAT(
      test::message_of(ErrorKind::usage,
                       [&] { read("name,east,north\n" + std::string(500, 'x') + ",1,2\n"); }),
      HasSubstr("none of its 1 points has a name of 1 … 80 letters"));
}

// Waypoints of GPX, places of OpenStreetMap, layers with different columns.
TEST_F(LabelPoints, OfVectorFilesWithWhatColumnsTheyHave) {
  const std::string gpx = folder_.write(
      "way.gpx",
      R"(<?xml version="1.0"?><gpx version="1.1" creator="test" xmlns="http://www.topografix.com/GPX/1/1"><wpt lat="47.41" lon="11.43"><ele>2749</ele><name>Birkkar</name></wpt><trk><name>T</name><trkseg><trkpt lat="47.2" lon="11.2"/><trkpt lat="47.1" lon="11.3"/></trkseg></trk></gpx>)");
  const std::vector<LabelPoint> points = read_label_points(gpx, "EPSG:32632", style_, progress_);
  ASSERT_EQ(points.size(), 1U) << "places of tracks are no points";
  EXPECT_EQ(points[0].name, "Birkkar");
  EXPECT_EQ(points[0].altitude_m, 2749.0);
  EXPECT_NEAR(points[0].position.x, 683313.0, 100.0);
  const std::string osm = folder_.write(
      "places.osm",
      R"(<osm version="0.6"><node id="1" lat="47.35" lon="11.71" version="1"><tag k="name" v="Schwaz"/><tag k="place" v="town"/></node></osm>)");
  const std::vector<LabelPoint> towns = read_label_points(osm, "EPSG:32632", style_, progress_);
  ASSERT_EQ(towns.size(), 1U);
  EXPECT_EQ(towns[0].kind, style_.find("town"));
  const std::string lines = folder_.write(
      "lines.geojson",
      R"({"type":"Feature","properties":{"name":"A"},"geometry":{"type":"LineString","coordinates":[[11,47],[11.1,47]]}})");
  EXPECT_THAT(test::message_of(ErrorKind::input,
                               [&] { read_label_points(lines, "EPSG:32632", style_, progress_); }),
              HasSubstr("no points in it"));
}

TEST_F(LabelPoints, WithoutNamesWhereNoneAreNeeded) {
  const std::string file = folder_.write("bare.csv", "east,north\n1,2\n3,4\n");
  EXPECT_EQ(read_label_points(file, "", style_, progress_, NamesAre::optional).size(), 2U);
}

// Summits of the DEM without a named one remain.
TEST(UnnamedSummits, AreThoseThatNobodyNamed) {
  const LabelStyle style = load_label_style("classic");
  const GeoTransform transform{0.0, 10000.0, 100.0, 100.0};
  LabelPoint named;
  named.name = "A";
  named.position = transform.to_crs(20.0, 20.0) + glm::dvec2(150.0, 0.0);
  const std::vector<LabelPoint> rest = unnamed_summits(
      {{20, 20, 2000.F, 900.F}, {50, 20, 1500.F, 300.F}}, transform, 100.0, {named}, style);
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest[0].position, transform.to_crs(50.0, 20.0));
  EXPECT_TRUE(rest[0].name.empty());
  EXPECT_GT(rest[0].rank, 6.0);
  named.kind = style.find("town");
  EXPECT_EQ(unnamed_summits({{20, 20, 2000.F, 900.F}}, transform, 100.0, {named}, style).size(), 1U)
      << "a town names no summit";
}

}  // namespace
}  // namespace belvedere
