#include "renderer/features/footprint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/renderer/features/rectangle.h"

namespace belvedere {
namespace {

using test::rectangle;
using Ring = std::vector<glm::dvec2>;

Ring turned(Ring ring, double turn) {
  for (glm::dvec2& p : ring)
    p = {7.0 + p.x * std::cos(turn) - p.y * std::sin(turn),
         -3.0 + p.x * std::sin(turn) + p.y * std::cos(turn)};
  return ring;
}

double area_of(const Footprint& foot) {
  return 4.0 * glm::length(foot.along) * glm::length(foot.across);
}

bool covers(const std::vector<Footprint>& wings, glm::dvec2 position) {
  for (const Footprint& wing : wings) {
    const glm::dvec2 off = position - wing.centre;
    if (std::abs(glm::dot(off, glm::normalize(wing.along))) < glm::length(wing.along) &&
        std::abs(glm::dot(off, glm::normalize(wing.across))) < glm::length(wing.across))
      return true;
  }
  return false;
}

TEST(Footprint, IsFoundWhateverItsTurn) {
  for (const double turn : {0.0, 0.3, 1.1, 2.0}) {
    std::vector<glm::dvec2> outline = rectangle({40.0, -20.0}, 30.0, 12.0, turn);
    outline.push_back(0.5 * (outline.front() + outline.back()));  // a point along a wall
    const Footprint foot = footprint_of(outline);
    EXPECT_LT(glm::length(foot.centre - glm::dvec2(40.0, -20.0)), 1e-9);
    EXPECT_NEAR(glm::length(foot.along), 15.0, 1e-9);
    EXPECT_NEAR(glm::length(foot.across), 6.0, 1e-9);
    EXPECT_NEAR(std::abs(glm::dot(foot.along / 15.0, glm::dvec2(std::cos(turn), std::sin(turn)))),
                1.0, 1e-9);
  }
}

TEST(Wings, ARectangleIsOne) {
  const std::vector<Footprint> wings = wings_of({rectangle({0.0, 0.0}, 30.0, 12.0, 0.4)});
  ASSERT_EQ(wings.size(), 1U);
  EXPECT_NEAR(area_of(wings[0]), 360.0, 1e-6);
  // With a bay of 2 × 3 m on one side as well.
  EXPECT_EQ(wings_of({{{0, 0}, {30, 0}, {30, 12}, {16, 12}, {16, 14}, {13, 14}, {13, 12}, {0, 12}}})
                .size(),
            1U);
}

// An L of 30 × 10 and 10 × 25: two wings that share its corner, for any rotation.
TEST(Wings, AnLHasTwoThatMeetInItsCorner) {
  const Ring l = {{0, 0}, {30, 0}, {30, 10}, {10, 10}, {10, 25}, {0, 25}};
  for (const double turn : {0.0, 0.37, 1.2}) {
    const Ring ring = turned(l, turn);
    const std::vector<Footprint> wings = wings_of({ring});
    ASSERT_EQ(wings.size(), 2U) << turn;
    EXPECT_NEAR(area_of(wings[0]), 300.0, 1e-6) << "the largest is the first";
    EXPECT_NEAR(area_of(wings[1]), 250.0, 1e-6) << "the other reaches into the corner";
    EXPECT_NEAR(glm::dot(glm::normalize(wings[0].along), glm::normalize(wings[1].along)), 0.0,
                1e-9);
    EXPECT_FALSE(covers(wings, turned({{20, 20}}, turn)[0])) << "the open corner";
    for (const glm::dvec2 in : {glm::dvec2(5, 5), glm::dvec2(28, 5), glm::dvec2(5, 23)})
      EXPECT_TRUE(covers(wings, turned({in}, turn)[0]));
  }
}

// The mirror image: the position of the corner does not matter.
TEST(Wings, AnLMayLieAnyWayRound) {
  for (const double sx : {1.0, -1.0})
    for (const double sy : {1.0, -1.0}) {
      Ring l = {{0, 0}, {30, 0}, {30, 10}, {10, 10}, {10, 25}, {0, 25}};
      for (glm::dvec2& corner : l) corner *= glm::dvec2(sx, sy);
      const std::vector<Footprint> wings = wings_of({l});
      ASSERT_EQ(wings.size(), 2U) << sx << ' ' << sy;
      EXPECT_NEAR(area_of(wings[0]), 300.0, 1e-6);
      EXPECT_NEAR(area_of(wings[1]), 250.0, 1e-6) << sx << ' ' << sy;
    }
}

TEST(Wings, ACourtStaysOpen) {
  const Ring outer = {{0, 0}, {40, 0}, {40, 30}, {0, 30}};
  const Ring court = {{10, 8}, {10, 22}, {30, 22}, {30, 8}};
  const std::vector<Footprint> wings = wings_of({turned(outer, 0.2), turned(court, 0.2)});
  ASSERT_EQ(wings.size(), 4U);
  EXPECT_FALSE(covers(wings, turned({{20, 15}}, 0.2)[0]));
  for (const glm::dvec2 in : {glm::dvec2(20, 4), glm::dvec2(20, 26), glm::dvec2(5, 15),
                              glm::dvec2(35, 15), glm::dvec2(2, 2)})
    EXPECT_TRUE(covers(wings, turned({in}, 0.2)[0]));
}

// Outlines without straight wings keep the rectangle around them, or few rectangles inside them; no
// house is lost.
TEST(Wings, RoundAndBrokenOutlinesBecomeFewRectangles) {
  Ring round;
  for (int k = 0; k < 60; ++k)
    round.emplace_back(20.0 * std::cos(k * 0.10472), 20.0 * std::sin(k * 0.10472));
  const std::vector<Footprint> wings = wings_of({round});
  EXPECT_LE(wings.size(), 8U);
  EXPECT_TRUE(covers(wings, {0.3, 0.2}));
  EXPECT_FALSE(covers(wings, {19.5, 19.5}));
  EXPECT_EQ(wings_of({{{0, 0}, {10, 0}, {0, 10}}}).size(), 1U);
  EXPECT_EQ(wings_of({{{1, 1}, {1, 1}, {1, 1}}}).size(), 1U);
  EXPECT_EQ(wings_of({{{0, 0}, {10, 0}, {20, 0}, {5, 0}, {3, 0}, {2, 0}}}).size(), 1U) << "a line";
}

}  // namespace
}  // namespace belvedere
