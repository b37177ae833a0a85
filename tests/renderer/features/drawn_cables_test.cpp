#include "renderer/features/drawn_cables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/renderer/features/test_ground.h"

namespace belvedere {
namespace {

using test::line_feature;
using test::set_of;
using test::TestGround;

FeatureStyle cable_style() {
  return parse_feature_style(R"(version = 1
[kinds.lift]
draw = "cable"
width_mm = 0.5
casing_mm = 0
shrink = 0
height_mm = 0
height_m = 20
pylon_mm = 15
)",
                             "test.toml");
}

DrawnFeatures draw_cable(const TestGround& ground, std::vector<glm::dvec2> stations) {
  return draw_features(set_of(cable_style(), {line_feature(0, std::move(stations), cable_style())}),
                       ground.sight(), {.px_per_mm = 2.0});
}

std::size_t count(const DrawnFeatures& drawn, LinePart part) {
  return static_cast<std::size_t>(
      std::count_if(drawn.lines.begin(), drawn.lines.end(),
                    [&](const DrawnLine& line) { return line.part == part; }));
}

TEST(DrawnCables, HangStraightFromStationToStationAboveThePlane) {
  const TestGround ground([](glm::dvec2 p) { return 0.1 * p.y; });
  const DrawnFeatures drawn = draw_cable(ground, {{-400.0, -300.0}, {500.0, 900.0}});
  ASSERT_EQ(count(drawn, LinePart::rope), 1U);
  EXPECT_EQ(count(drawn, LinePart::station), 2U);
  EXPECT_GT(count(drawn, LinePart::pylon), 1U);
  const DrawnLine& rope =
      *std::find_if(drawn.lines.begin(), drawn.lines.end(),
                    [](const DrawnLine& line) { return line.part == LinePart::rope; });
  for (std::size_t k = 0; k < rope.points.size(); ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(rope.points.size() - 1);
    const glm::dvec2 map = glm::mix(glm::dvec2(-400.0, -300.0), glm::dvec2(500.0, 900.0), t);
    const glm::dvec2 pixel = ground.pixel({map, 0.1 * map.y + 20.0});
    EXPECT_LT(glm::length(glm::dvec2(rope.points[k].position) - pixel), 0.05)
        << "20 m over the ground";
  }
  EXPECT_EQ(drawn.counts[0][0].drawn, 1U);
}

// Over a gorge the rope does not follow the ground down.
TEST(DrawnCables, AreTightOverHollowsAndClearOfRidges) {
  const auto gorge = [](glm::dvec2 p) {
    return std::abs(p.x) < 150.0 ? -400.0 : std::abs(p.x - 400.0) < 30.0 ? 120.0 : 0.0;
  };
  const TestGround ground(gorge);
  const DrawnFeatures drawn = draw_cable(ground, {{-500.0, 0.0}, {600.0, 0.0}});
  const double over_gorge =
      ground.pixel({0.0, 0.0, -90.0}).y;  // 6 % of 1100 m below the stations, and some
  const double over_ridge = ground.pixel({400.0, 0.0, 135.0}).y;
  double lowest = 0.0;
  double highest = 1e9;
  // The ridge, which runs towards the viewer, hides some of it.
  for (const DrawnLine& line : drawn.lines)
    for (const DrawnPoint& point : line.points) {
      if (line.part != LinePart::rope) continue;
      if (std::abs(point.position.x - ground.pixel({0.0, 0.0, 0.0}).x) < 10.0)
        lowest = std::max(lowest, static_cast<double>(point.position.y));
      highest = std::min(highest, static_cast<double>(point.position.y));
    }
  for (const DrawnLine& line : drawn.lines)
    if (line.part == LinePart::pylon) {
      EXPECT_LT(line.points[0].position.y - line.points[1].position.y,
                0.3 * (ground.pixel({0.0, 0.0, -400.0}).y - over_gorge))
          << "none in the gorge";
    }
  EXPECT_GT(lowest, 0.0);
  EXPECT_LT(lowest, over_gorge);
  EXPECT_LT(highest, over_ridge);
}

TEST(DrawnCables, AreHiddenByMountains) {
  const TestGround ground([](glm::dvec2 p) { return std::abs(p.y) < 100.0 ? 900.0 : 0.0; });
  const DrawnFeatures drawn = draw_cable(ground, {{-400.0, 600.0}, {400.0, 600.0}});
  EXPECT_TRUE(drawn.lines.empty());
  EXPECT_EQ(drawn.counts[0][0].hidden, 1U);
  EXPECT_EQ(draw_cable(ground, {{9000.0, 0.0}, {9500.0, 0.0}}).counts[0][0].outside_terrain, 1U);
}

}  // namespace
}  // namespace belvedere
