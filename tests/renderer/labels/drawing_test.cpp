#include "renderer/labels/drawing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace belvedere {
namespace {

std::vector<glm::dvec2> half_circle(double radius) {
  std::vector<glm::dvec2> line;
  for (int k = 0; k <= 720; ++k) {
    const double angle = std::acos(-1.0) * (1.0 - k / 720.0);
    line.emplace_back(radius * std::cos(angle), -radius * std::sin(angle));
  }
  return line;
}

// On a circle letters are at angles given by their widths alone, each rotated to the tangent there.
TEST(Drawing, LettersStandOnACircleWhereItsArcHasThem) {
  const double r = 500.0;
  const std::vector<double> widths = {30.0, 50.0, 20.0, 40.0};
  const std::vector<LetterPosition> positions = set_along(widths, half_circle(r));
  ASSERT_EQ(positions.size(), widths.size());
  double from = -70.0;  // the text is 140 long, its centre at the top
  for (std::size_t i = 0; i < widths.size(); ++i) {
    const double angle = (from + .5 * widths[i]) / r;
    EXPECT_NEAR(positions[i].at.x, r * std::sin(angle), .05);
    EXPECT_NEAR(positions[i].at.y, -r * std::cos(angle), .05);
    EXPECT_NEAR(positions[i].tangent.x, std::cos(angle), .003);
    EXPECT_NEAR(positions[i].tangent.y, std::sin(angle), .003);
    from += widths[i];
  }
  EXPECT_TRUE(set_along({2000.0}, half_circle(r)).empty()) << "longer than the line";
}

TEST(Drawing, MovesAllThatAShapeStandsOn) {
  DrawnShape text = DrawnText{
      .text = "A", .type = {}, .at = {1, 2}, .colour = "#000000", .along = {{3, 4}, {5, 6}}};
  move_shape(text, {10, 20});
  EXPECT_EQ(std::get<DrawnText>(text).at, glm::dvec2(11, 22));
  EXPECT_EQ(std::get<DrawnText>(text).along[1], glm::dvec2(15, 26));
}

}  // namespace
}  // namespace belvedere
