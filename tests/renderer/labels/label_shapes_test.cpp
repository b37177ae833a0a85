#include "renderer/labels/label_shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "renderer/labels/drawing.h"
#include "renderer/labels/labels.h"
#include "tests/files.h"

namespace belvedere {
namespace {

// A curved band of constant width: its centreline is the arc it was made from.
TEST(LabelShapes, TheMiddleOfABandIsTheLineItWasMadeFrom) {
  std::vector<glm::dvec2> ring;
  const auto arc = [](double x) { return 200.0 + .0006 * (x - 500.0) * (x - 500.0); };
  for (int x = 0; x <= 1000; x += 10) ring.emplace_back(x, arc(x) - 15.0);
  for (int x = 1000; x >= 0; x -= 10) ring.emplace_back(x, arc(x) + 15.0);
  const std::vector<glm::dvec2> centre = centreline({ring});
  ASSERT_GT(centre.size(), 40U);
  for (std::size_t i = 0; i < centre.size(); ++i) {
    EXPECT_NEAR(centre[i].y, arc(centre[i].x), 2.0);
    if (i > 0) {
      EXPECT_GT(centre[i].x, centre[i - 1].x);
    }
  }
}

// An island at the centre: the line goes through the wider water beside it.
TEST(LabelShapes, TheMiddleKeepsOffIslands) {
  const std::vector<glm::dvec2> lake = {{0, 0}, {300, 0}, {300, 100}, {0, 100}};
  const std::vector<glm::dvec2> island = {{100, 10}, {200, 10}, {200, 40}, {100, 40}};
  for (const glm::dvec2 p : centreline({lake, island}))
    if (p.x > 105 && p.x < 195) {
      EXPECT_NEAR(p.y, 70.0, .5);
    }
}

TEST(LabelShapes, ABaselineFollowsItsLineFromLeftToRight) {
  // Given from right to left, as a river may flow, with the jags of pixels.
  std::vector<glm::dvec2> line;
  for (int x = 900; x >= 100; x -= 4)
    line.emplace_back(x, 300.0 + 60.0 * std::sin(x / 250.0) + (x % 8 == 0 ? 1.5 : -1.5));
  const std::vector<std::vector<glm::dvec2>> found = fitted_baselines(line, 300.0, 0.0);
  ASSERT_GE(found.size(), 3U);
  for (const std::vector<glm::dvec2>& baseline : found) {
    EXPECT_GE(length_of(baseline), 300.0);
    for (std::size_t i = 0; i + 1 < baseline.size(); ++i) {
      const glm::dvec2 step = glm::normalize(baseline[i + 1] - baseline[i]);
      EXPECT_GT(step.x, .57) << "upright";
      if (i > 0) {
        EXPECT_GT(glm::dot(step, glm::normalize(baseline[i] - baseline[i - 1])), .999) << "smooth";
      }
    }
  }
  const glm::dvec2 centre = found[0][found[0].size() / 2];
  EXPECT_NEAR(centre.y, 300.0 + 60.0 * std::sin(centre.x / 250.0), 6.0);
  EXPECT_NEAR(fitted_baselines(line, 300.0, 10.0)[0][20].y, found[0][20].y - 10.0, 1.5) << "lifted";
}

// Where the centre of a ridge is taken by a summit's mark, the name is below the crest rather than
// far off along it.
TEST(LabelShapes, AsideOfTheLineComesBeforeFarOffItsMiddle) {
  std::vector<glm::dvec2> line;
  for (int x = 100; x <= 900; x += 4) line.emplace_back(x, 300.0);
  const auto centre_of = [](const std::vector<glm::dvec2>& arc) { return arc[arc.size() / 2]; };
  const std::vector<std::vector<glm::dvec2>> only_on = fitted_baselines(line, 200.0, 0.0);
  const std::vector<std::vector<glm::dvec2>> found = fitted_baselines(line, 200.0, 0.0, 25.0);
  EXPECT_EQ(found.size(), 3U * only_on.size());
  std::size_t below = 0, far_off = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (below == 0 && std::abs(centre_of(found[i]).y - 325.0) < .1) {
      below = i;
      EXPECT_NEAR(centre_of(found[i]).x, 500.0, 2.0);
    }
    if (far_off == 0 && std::abs(centre_of(found[i]).x - 500.0) > 150.0) far_off = i;
  }
  EXPECT_NEAR(centre_of(found[0]).y, 300.0, .1) << "first on the line itself";
  EXPECT_GT(below, 0U);
  EXPECT_LT(below, far_off);
}

TEST(LabelShapes, NoBaselineWhereLettersWouldStandOnEndOrFindNoRoom) {
  EXPECT_TRUE(fitted_baselines({{100, 100}, {110, 600}}, 200.0, 0.0).empty()) << "upright line";
  EXPECT_TRUE(fitted_baselines({{100, 100}, {180, 100}}, 200.0, 0.0).empty()) << "too short";
  EXPECT_FALSE(fitted_baselines({{100, 100}, {240, 100}}, 200.0, 0.0).empty())
      << "may pass its ends a little";
  EXPECT_TRUE(fitted_baselines({}, 200.0, 0.0).empty());
}

TEST(LabelShapes, AreReadWithTheirNamesAndLongNamesAreLeftOut) {
  const std::string path = testing::TempDir() + "label_shapes.geojson";
  std::ofstream(path)
      << R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"name":"Inntal","kind":"tal","rank":2},"geometry":{"type":"LineString","coordinates":[[11,47],[11.1,47]]}},
{"type":"Feature","properties":{"name":"Inntal","kind":"valley","rank":2},"geometry":{"type":"LineString","coordinates":[[11.1,47],[11.2,47]]}},
{"type":"Feature","properties":{"name":"See","kind":"lake","rank":null},"geometry":{"type":"Polygon","coordinates":[[[11,47],[11.1,47],[11,47.1],[11,47]]]}},
{"type":"Feature","properties":{"name":")"
      << std::string(500, 'x')
      << R"(","kind":"lake","rank":3},"geometry":{"type":"LineString","coordinates":[[11,47],[11.1,47]]}}]})";
  const LabelStyle style = load_label_style("classic");
  const std::vector<LabelShape> shapes =
      read_label_shapes(path, "EPSG:32632", style, silent_progress());
  ASSERT_EQ(shapes.size(), 2U);
  EXPECT_EQ(shapes[0].point.name, "Inntal");
  EXPECT_EQ(shapes[0].point.kind, style.find("valley"));
  EXPECT_EQ(shapes[0].point.rank, 2.0);
  EXPECT_EQ(shapes[0].parts.size(), 2U) << "two lines of one valley";
  EXPECT_TRUE(shapes[1].is_area);
  EXPECT_EQ(shapes[1].point.rank, 5.0);
}

// Along its line the name is spread, its letters overlap no other name, and where nothing fits it
// is set like a point's.
TEST(LabelShapes, NamesBendAlongTheirLineAndKeepOffOthers) {
  const LabelStyle style = load_label_style("classic");
  std::vector<LabelPoint> points(2);
  points[0].name = "Hinterautal";
  points[0].kind = style.find("valley");
  points[0].rank = 5;
  points[1].name = "Innsbruck";
  points[1].kind = style.find("town");
  points[1].rank = 1;
  std::vector<LabelMark> marks(2);
  marks[0].state = marks[1].state = MarkState::seen;
  marks[0].pixel = marks[1].pixel = {1000, 400};
  std::vector<glm::dvec2> line;
  for (int x = 300; x <= 1700; x += 10)
    line.emplace_back(x, 400.0 + .0001 * (x - 1000.0) * (x - 1000.0));
  const LabelSheet sheet =
      make_labels(points, marks, std::vector<double>(2000, 0.0), style, {2000, 800}, 500.0, {line});
  const LabelSpot& bent = sheet.labels[0].spot;
  ASSERT_TRUE(bent.placed);
  EXPECT_FALSE(bent.baseline.empty());
  EXPECT_GT(sheet.labels[0].spacing, style.kinds[static_cast<std::size_t>(points[0].kind)].spacing);
  ASSERT_TRUE(sheet.labels[1].spot.placed);
  ASSERT_EQ(bent.letters.size(), 11U);
  for (const LabelBox& letter : bent.letters)
    EXPECT_FALSE(letter.overlaps(sheet.labels[1].spot.text));
}

}  // namespace
}  // namespace belvedere
