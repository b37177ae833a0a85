#include "renderer/features/drawn_features.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/grids.h"
#include "tests/renderer/features/test_ground.h"

namespace belvedere {
namespace {

using test::line_feature;
using test::set_of;
using test::TestGround;

FeatureStyle line_style() {
  return parse_feature_style(R"(version = 1
[kinds.road]
width_mm = 2
shrink = 0
min_share = 0
hand = 0
[kinds.near_road]
coarsest_m = 12
[kinds.shrinking]
width_mm = 2
min_px = 0
shrink = 0.5
min_share = 0.1
[kinds.real]
width_mm = 0.01
min_px = 0
real_m = 100
)",
                             "test.toml");
}

DrawnFeatures draw(const TestGround& ground, int kind, std::vector<glm::dvec2> positions) {
  const GroundSight sight = ground.sight();
  return draw_features(
      set_of(line_style(), {line_feature(kind, std::move(positions), line_style())}), sight,
      {.px_per_mm = 2.0});
}

double distance_to_segment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const double t = std::clamp(glm::dot(p - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
  return glm::length(p - a - t * (b - a));
}

// A camera maps straight lines to straight lines, and a tilted plane contains them.
TEST(DrawnFeatures, AStraightRoadOnAPlaneLandsOnItsPixels) {
  const TestGround ground([](glm::dvec2 p) { return 0.05 * p.x + 0.1 * p.y; });
  const glm::dvec2 from{-700.0, -900.0};
  const glm::dvec2 to{900.0, 1500.0};
  const DrawnFeatures drawn = draw(ground, 0, {from, to});
  ASSERT_EQ(drawn.lines.size(), 1U);
  const auto point = [](glm::dvec2 p) { return glm::dvec3(p, 0.05 * p.x + 0.1 * p.y); };
  const glm::dvec2 a = ground.pixel(point(from));
  const glm::dvec2 b = ground.pixel(point(to));
  const std::vector<DrawnPoint>& points = drawn.lines[0].points;
  EXPECT_LT(glm::length(glm::dvec2(points.front().position) - a), 0.02);
  EXPECT_LT(glm::length(glm::dvec2(points.back().position) - b), 0.02);
  for (const DrawnPoint& p : points) {
    EXPECT_LT(distance_to_segment(glm::dvec2(p.position), a, b), 0.05);
    EXPECT_FLOAT_EQ(p.half_px, 2.F) << "2 mm of the sheet at 2 px a mm, half of it";
  }
  EXPECT_NEAR(drawn.counts[0][0].length_m, glm::length(to - from), 1e-6);
  EXPECT_NEAR(drawn.counts[0][0].seen_m, glm::length(to - from), 1e-6);
}

// Widened valleys move the ground with everything on it.
TEST(DrawnFeatures, GoesAlongWithGroundThatMoved) {
  TestGround ground([](glm::dvec2 p) { return 0.05 * p.x + 0.1 * p.y; });
  const DrawnFeatures there = draw(ground, 0, {{300.0, -900.0}, {300.0, 1500.0}});
  ground.goes_to =
      Grid<glm::vec2>(ground.surface.vertices_m.width(), ground.surface.vertices_m.height(),
                      glm::vec2(static_cast<float>(120.0 / ground.transform.cell_x), 0.F));
  const DrawnFeatures moved = draw(ground, 0, {{180.0, -900.0}, {180.0, 1500.0}});
  ASSERT_EQ(moved.lines.size(), 1U);
  EXPECT_LT(glm::length(glm::dvec2(moved.lines[0].points.front().position -
                                   there.lines[0].points.front().position)),
            0.02);
  EXPECT_LT(glm::length(glm::dvec2(moved.lines[0].points.back().position -
                                   there.lines[0].points.back().position)),
            0.02);
}

// Over uneven ground the line in the picture follows the ground's own, to a third of a pixel.
TEST(DrawnFeatures, FollowsTheGroundItLiesOn) {
  const TestGround ground(
      [](glm::dvec2 p) { return 60.0 * std::sin(p.x / 140.0) * std::cos(p.y / 200.0); });
  const glm::dvec2 from{-1200.0, 200.0};
  const glm::dvec2 to{1300.0, 500.0};
  const DrawnFeatures drawn = draw(ground, 0, {from, to});
  const GroundSight sight = ground.sight();
  for (int k = 0; k <= 997; ++k) {
    const glm::dvec3 point = *sight.ground(from + (to - from) * (k / 997.0));
    const glm::dvec2 pixel = ground.pixel(point);
    if (sight.hidden_by_m({{point, pixel, sight.distance_m(point, pixel)}})[0] > 0.0) continue;
    double nearest = 1e9;
    for (const DrawnLine& line : drawn.lines)
      for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
        nearest = std::min(nearest, distance_to_segment(pixel, glm::dvec2(line.points[i].position),
                                                        glm::dvec2(line.points[i + 1].position)));
    EXPECT_LT(nearest, 0.45) << k;
  }
}

// From height H, at distance D from a wall of height h, level ground is hidden for h D / (H - h)
// behind it.
TEST(DrawnFeatures, AWallHidesWhatLiesBehindIt) {
  constexpr double wall_m = 300.0;
  const TestGround ground([](glm::dvec2 p) { return std::abs(p.y) < 4.0 ? wall_m : 0.0; });
  const DrawnFeatures drawn = draw(ground, 0, {{0.0, -800.0}, {0.0, 1800.0}});
  const double hidden_m = wall_m * 3000.0 / (1500.0 - wall_m);
  ASSERT_EQ(drawn.lines.size(), 2U);
  const glm::dvec2 out = ground.pixel({0.0, hidden_m, 0.0});
  EXPECT_NEAR(static_cast<double>(drawn.lines[1].points.front().position.y), out.y, 0.6);
  // The line climbs the near side of the wall, which is 10 m wide on the map.
  EXPECT_NEAR(drawn.counts[0][0].seen_m, 2600.0 - hidden_m, 30.0);
  EXPECT_EQ(drawn.counts[0][0].drawn, 1U);
}

TEST(DrawnFeatures, BumpsOfTheGroundDoNotMakeDashes) {
  // Ripples of a metre that a low eye looks across.
  const TestGround ground([](glm::dvec2 p) { return 1.2 * std::sin(p.y / 9.0); },
                          {0.0, -3000.0, 260.0});
  EXPECT_EQ(draw(ground, 0, {{0.0, 0.0}, {30.0, 1900.0}}).lines.size(), 1U);
}

TEST(DrawnFeatures, CountsSayWhatBecameOfEach) {
  const TestGround ground([](glm::dvec2 p) { return p.y > 600.0 && p.y < 650.0 ? 900.0 : 0.0; });
  const auto count = [&](int kind, std::vector<glm::dvec2> positions) {
    return draw(ground, kind, std::move(positions)).counts[0][static_cast<std::size_t>(kind)];
  };
  EXPECT_EQ(count(0, {{-100.0, 0.0}, {100.0, 0.0}}).drawn, 1U);
  EXPECT_EQ(count(0, {{9000.0, 0.0}, {9100.0, 0.0}}).outside_terrain, 1U);
  EXPECT_EQ(count(0, {{-1990.0, -1990.0}, {-1900.0, -1990.0}}).outside_picture, 1U);
  EXPECT_EQ(count(0, {{-100.0, 900.0}, {100.0, 900.0}}).hidden, 1U);
  EXPECT_EQ(count(1, {{-100.0, 500.0}, {100.0, 500.0}}).too_far, 1U);
  EXPECT_EQ(count(0, {{-100.0, 0.0}, {100.0, 0.0}}).features, 1U);
}

TEST(DrawnFeatures, WidthShrinksWithDistanceAsTheStyleSays) {
  const TestGround ground([](glm::dvec2) { return 0.0; });
  const DrawnFeatures drawn = draw(ground, 2, {{0.0, -900.0}, {0.0, 1800.0}});
  const GroundSight sight = ground.sight();
  const DrawnPoint& near = drawn.lines[0].points.front();
  const DrawnPoint& far = drawn.lines[0].points.back();
  const double ratio = sight.metres_per_px({0.0, -900.0, 0.0}, glm::dvec2(near.position)) /
                       sight.metres_per_px({0.0, 1800.0, 0.0}, glm::dvec2(far.position));
  EXPECT_LT(ratio, 0.7);
  EXPECT_NEAR(static_cast<double>(far.half_px / near.half_px), std::sqrt(ratio), 0.01);
}

TEST(DrawnFeatures, NoneIsNarrowerThanItIs) {
  const TestGround ground([](glm::dvec2) { return 0.0; });
  const DrawnFeatures drawn = draw(ground, 3, {{0.0, 0.0}, {0.0, 900.0}});
  const DrawnPoint& end = drawn.lines[0].points.back();
  // Across the line of sight 100 m are as wide as the distance between two positions 50 m to its
  // sides.
  const double wide =
      glm::length(ground.pixel({50.0, 900.0, 0.0}) - ground.pixel({-50.0, 900.0, 0.0}));
  EXPECT_NEAR(2.0 * static_cast<double>(end.half_px), wide, 0.01 * wide);
}

TEST(DrawnFeatures, FindsWhatTouchesARectangle) {
  const TestGround ground([](glm::dvec2) { return 0.0; }, {0.0, -3000.0, 1500.0}, 1200, 900);
  const DrawnFeatures drawn = draw(ground, 0, {{-900.0, -400.0}, {900.0, 1200.0}});
  ASSERT_FALSE(drawn.lines.empty());
  const glm::vec2 at = drawn.lines[0].points.front().position;
  const int x = static_cast<int>(at.x);
  const int y = static_cast<int>(at.y);
  EXPECT_EQ(drawn.lines_at({x, y, x + 1, y + 1}), std::vector<std::uint32_t>{0});
  EXPECT_TRUE(drawn.lines_at({1100, 10, 1101, 11}).empty());
  EXPECT_TRUE(no_features().lines_at({0, 0, 10, 10}).empty());
}

// Windows of finer cells replace coarse ones: the finest is used.
TEST(GroundSight, LooksAtTheFinestWindow) {
  TestGround ground([](glm::dvec2) { return 0.0; });
  SurfaceWindow window;
  window.replaces = {100, 100, 121, 121};
  window.part = {4, 4, 45, 45};
  window.surface.origin = ground.surface.origin;
  window.surface.vertices_m = Grid<glm::vec3>(49, 49);
  for (const auto [x, y] : test::cells(49, 49)) {
    const glm::dvec2 position =
        ground.transform.to_crs(100.0 + 0.5 * (x - 4), 100.0 + 0.5 * (y - 4));
    window.surface.vertices_m(x, y) = glm::vec3(glm::dvec3(position, 7.0) - ground.surface.origin);
  }
  const glm::dvec2 inside = ground.transform.to_crs(110.3, 112.6);
  const glm::dvec2 outside = ground.transform.to_crs(130.0, 112.0);
  ground.surface.windows.push_back(window);
  const GroundSight sight = ground.sight();
  EXPECT_NEAR(sight.ground(inside)->z, 7.0, 1e-6);
  EXPECT_NEAR(sight.ground(inside)->x, inside.x, 1e-3);
  EXPECT_NEAR(sight.ground(outside)->z, 0.0, 1e-6);
  EXPECT_FALSE(sight.ground({5000.0, 0.0}));
  EXPECT_DOUBLE_EQ(sight.cell_m(), 5.0);
}

}  // namespace
}  // namespace belvedere
