#include "renderer/labels/label_points.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <utility>

#include "base/progress.h"
#include "renderer/world/world.h"
#include "terrain/shape/valley_floor.h"
#include "tests/files.h"
#include "tests/notes.h"
#include "tests/scenes.h"

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
  EXPECT_EQ(read("name,kind,east,north\nA,spaceport,1,2\n")[0].kind, 0);
  EXPECT_THAT(progress_.text(), HasSubstr("spaceport"));
}

TEST_F(LabelPoints, WrongNumbersAreRefused) {
  const auto message = [&](const std::string& text) {
    return test::usage_error([&] { read(text); });
  };
  EXPECT_THAT(message("name,rank,east,north\nA,first,1,2\n"), HasSubstr("points.csv:2"));
  EXPECT_THAT(message("name,rank,east,north\nA,12,1,2\n"), HasSubstr("1 … 9"));
  EXPECT_THAT(message("title,east,north\nA,1,2\n"), HasSubstr("no column of names"));
}

TEST_F(LabelPoints, NamesThatAreNoTextAndFilesWithoutAnyAreRefused) {
  EXPECT_THAT(test::input_error([&] { read("name,east,north\nA,1,2\n\xD6tztal,1,2\n"); }),
              testing::AllOf(HasSubstr("points.csv:3"), HasSubstr("UTF-8")));
  for (const char* bad : {"\xC0\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE2\x82", "\x80"})
    EXPECT_THAT(test::input_error([&] { read(std::string("name,east,north\n") + bad + ",1,2\n"); }),
                HasSubstr("UTF-8"));
  EXPECT_EQ(read("name,east,north\nÖtztal 御嶽山 𝄞,1,2\n").size(), 1U);
  EXPECT_THAT(
      test::usage_error([&] { read("name,east,north\n" + std::string(500, 'x') + ",1,2\n"); }),
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
  EXPECT_THAT(test::input_error([&] { read_label_points(lines, "EPSG:32632", style_, progress_); }),
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

// The small scene, exaggerated and bent, at a size where a pixel is small.
class LabelMarks : public testing::Test {
 protected:
  std::vector<LabelMark> marks_of(const std::vector<LabelPoint>& points) const {
    return find_marks({bare_.dem->altitude_m, *bare_.generalized_m, bare_.dem->transform,
                       bare_.dem->cell_m(), map_},
                      points, style_);
  }
  LabelPoint point(glm::dvec2 position, const char* kind = "summit") const {
    LabelPoint p;
    p.name = "A";
    p.kind = style_.find(kind);
    p.position = position;
    return p;
  }
  std::vector<Summit> summits() const {
    return find_summits(*bare_.generalized_m, {.min_prominence_m = 60.0});
  }
  glm::dvec2 position_of(const Summit& s) const { return bare_.dem->transform.to_crs(s.x, s.y); }

  const BareView bare_ =
      make_bare_view(test::small_scene({"output.width=960", "output.height=800",
                                        "deform.exaggeration=1.5", "deform.bend.radius_m=40000"}),
                     silent_progress());
  const GeoMap map_ = bare_.geo_map();
  const LabelStyle style_ = load_label_style("classic");
};

// An oracle without knowledge of summits: the drawn top is the highest position of the picture that
// shows ground around it.
TEST_F(LabelMarks, StandOnTheSummitAsItIsDrawn) {
  std::size_t skyline = 0;
  for (const Summit& summit : summits()) {
    // The file's position is a cell and a half off.
    const LabelMark mark = marks_of({point(position_of(summit) + glm::dvec2(-110.0, 100.0))})[0];
    if (mark.state != MarkState::seen || !mark.on_skyline) continue;
    ++skyline;
    double top = mark.pixel.y + 20.0;
    for (double x = mark.pixel.x - 3.0; x <= mark.pixel.x + 3.0; x += .5) {
      double y = mark.pixel.y + 20.0;
      while (y > 0.0 && map_.to_geo({x, y})) y -= .25;
      top = std::min(top, y);
    }
    EXPECT_NEAR(mark.pixel.y, top, 2.0);
  }
  EXPECT_GE(skyline, 1U);
}

// Seen from high above, the edge behind which a summit falls out of sight is not its top. The
// oracle uses the picture alone: above the mark it shows ground far behind what it shows below the
// mark.
TEST_F(LabelMarks, StandOnTheEdgeThatIsSeenFromAbove) {
  std::size_t moved = 0;
  for (const auto& [height_m, pitch_deg] :
       {std::pair(4500.0, -18.0), {6000.0, -22.0}, {8000.0, -32.0}}) {
    const BareView high = make_bare_view(
        test::small_scene({"output.width=2400", "output.height=2000", "deform.exaggeration=1.5",
                           fmt::format("camera.height_m={}", height_m),
                           fmt::format("camera.pitch_deg={}", pitch_deg)}),
        silent_progress());
    const GeoMap map = high.geo_map();
    const LocatedGround ground{high.dem->altitude_m, *high.generalized_m, high.dem->transform,
                               high.dem->cell_m(), map};
    for (const Summit& summit : find_summits(*high.generalized_m, {.min_prominence_m = 60.0})) {
      const LabelPoint file_point = point(high.dem->transform.to_crs(summit.x, summit.y));
      const LabelMark mark = find_marks(ground, {file_point}, style_)[0];
      if (mark.state != MarkState::seen) continue;
      const auto top = map.to_image(mark.drawn_position);
      ASSERT_TRUE(top && top->visible);
      EXPECT_LE(mark.pixel.y, top->pixel.y);
      if (mark.pixel.y > top->pixel.y - 2.0) continue;
      ++moved;
      const auto over = map.to_geo(mark.pixel - glm::dvec2(0.0, 2.0));
      const auto under = map.to_geo(mark.pixel + glm::dvec2(0.0, 1.0));
      ASSERT_TRUE(under);
      EXPECT_LT(glm::length(under->position - mark.drawn_position), 600.0) << "still this summit";
      EXPECT_TRUE(!over || over->distance_m > under->distance_m + 200.0)
          << height_m << ": the same slope goes on over the mark";
    }
  }
  EXPECT_GE(moved, 1U);
}

// As profiles of tracks have it: bilinear, exactly the cell's own value at its centre.
TEST_F(LabelMarks, AltitudesBetweenCellsAreInterpolated) {
  const Grid<float>& z = bare_.dem->altitude_m;
  for (int y = z.height() / 4; y < 3 * z.height() / 4; y += 13)
    for (int x = z.width() / 4; x < 3 * z.width() / 4; x += 11) {
      const auto altitude = [&](double column, double row) {
        return marks_of({point(bare_.dem->transform.to_crs(column, row), "town")})[0]
            .dem_altitude_m;
      };
      EXPECT_NEAR(altitude(x, y), z(x, y), 1e-3);
      EXPECT_NEAR(altitude(x + .5, y), .5 * (z(x, y) + z(x + 1, y)), 1e-2);
      EXPECT_NEAR(altitude(x + .25, y + .5),
                  .5 * (.75 * (z(x, y) + z(x, y + 1)) + .25 * (z(x + 1, y) + z(x + 1, y + 1))),
                  1e-2);
    }
}

TEST_F(LabelMarks, ClimbFromNearbyAndNotFromAfar) {
  const std::vector<Summit> found = summits();
  ASSERT_FALSE(found.empty());
  const LocatedGround ground{bare_.dem->altitude_m, *bare_.generalized_m, bare_.dem->transform,
                             bare_.dem->cell_m(), map_};
  const glm::dvec2 top = position_of(found[0]);
  const glm::dvec2 near = top + glm::dvec2(180.0, -90.0);
  EXPECT_EQ(climb(ground, near, 400.0), top);
  EXPECT_EQ(climb(ground, near, 100.0), near) << "farther than it may go: it stays";
  EXPECT_FALSE(climb(ground, {-5000.0, 0.0}, 400.0));
}

// Whatever state a point has, the map from the picture back to the ground agrees with it.
TEST_F(LabelMarks, SeenAndHiddenAgreeWithThePicture) {
  std::size_t seen = 0;
  std::size_t hidden = 0;
  for (double y = 500.0; y < 12000.0; y += 700.0)
    for (double x = 500.0; x < 12000.0; x += 700.0) {
      const LabelMark mark = marks_of({point({x, y}, "town")})[0];
      EXPECT_EQ(mark.drawn_position, glm::dvec2(x, y)) << "towns do not climb";
      if (mark.state == MarkState::seen) {
        ++seen;
        const auto back = map_.to_geo(mark.pixel);
        const auto again = back ? map_.to_image(back->position) : std::nullopt;
        EXPECT_TRUE(!again || glm::length(again->pixel - mark.pixel) < 1.0);
        EXPECT_FALSE(mark.in_front);
      } else if (mark.state == MarkState::hidden) {
        ++hidden;
        ASSERT_TRUE(mark.in_front);
        EXPECT_LT(mark.in_front->distance_m, mark.distance_m);
      }
    }
  EXPECT_GT(seen, 50U);
  EXPECT_GT(hidden, 5U);
}

TEST_F(LabelMarks, OutsideIsSaid) {
  EXPECT_EQ(marks_of({point({0.0, 90000.0}, "town")})[0].state, MarkState::outside_terrain);
  const BareView aside =
      make_bare_view(test::small_scene({"camera.azimuth_deg=90"}), silent_progress());
  const GeoMap map = aside.geo_map();
  const std::vector<LabelMark> marks = find_marks(
      {aside.dem->altitude_m, *aside.generalized_m, aside.dem->transform, aside.dem->cell_m(), map},
      {point({500.0, 500.0}, "town"), point({6500.0, 11000.0}, "town")}, style_);
  EXPECT_EQ(marks[0].state, MarkState::behind_eye);
  EXPECT_EQ(marks[1].state, MarkState::outside_picture);
}

}  // namespace
}  // namespace belvedere
