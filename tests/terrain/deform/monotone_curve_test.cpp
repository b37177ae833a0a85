#include "terrain/deform/monotone_curve.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

TEST(MonotoneCurve, PassesThroughItsPointsWithoutOvershooting) {
  const std::vector<glm::dvec2> points = {
      {0.0, 1.0}, {1.0, 1.1}, {4.0, 5.0}, {5.0, 5.0}, {9.0, 2.0}};
  const MonotoneCurve curve(points);
  for (const glm::dvec2& point : points) EXPECT_NEAR(curve.at(point.x), point.y, 1e-14);
  for (double x = 0.0; x < 4.0; x += 0.1) EXPECT_LE(curve.at(x), curve.at(x + 0.1) + 1e-14);
  for (double x = 4.0; x < 5.0; x += 0.1) EXPECT_NEAR(curve.at(x), 5.0, 1e-14);
  for (double x = 5.0; x < 9.0; x += 0.1) EXPECT_GE(curve.at(x), curve.at(x + 0.1) - 1e-14);
}

TEST(MonotoneCurve, IsConstantBeyondItsEnds) {
  const MonotoneCurve curve({{2.0, 3.0}, {6.0, 4.0}});
  EXPECT_EQ(curve.at(-10.0), 3.0);
  EXPECT_EQ(curve.at(6.0), 4.0);
  EXPECT_EQ(curve.at(100.0), 4.0);
  EXPECT_NEAR(curve.at(4.0), 3.5, 1e-14);
  EXPECT_EQ(MonotoneCurve({{5.0, 7.0}}).at(0.0), 7.0);
  EXPECT_EQ(MonotoneCurve().at(3.0), 1.0);
}

TEST(MonotoneCurve, IsSmoothAtItsPoints) {
  const MonotoneCurve curve({{0.0, 0.0}, {1.0, 1.0}, {3.0, 2.0}, {4.0, 6.0}});
  constexpr double h = 1e-6;
  for (const double x : {1.0, 3.0})
    EXPECT_NEAR((curve.at(x) - curve.at(x - h)) / h, (curve.at(x + h) - curve.at(x)) / h, 1e-4);
}

}  // namespace
}  // namespace belvedere
