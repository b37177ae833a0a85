#include "terrain/deform/bend_curve.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/math.h"
#include "tests/files.h"

namespace belvedere {
namespace {

BendCurve drops(std::vector<std::pair<double, double>> points) {
  BendCurve curve;
  for (const auto& [distance, drop] : points)
    curve.points.push_back({distance, drop, std::nullopt});
  return curve;
}

BendCurve inclinations(std::vector<std::pair<double, double>> points) {
  BendCurve curve;
  for (const auto& [distance, angle] : points)
    curve.points.push_back({distance, std::nullopt, angle});
  return curve;
}

const BendCurve steps = drops(
    {{10000, 9000}, {30000, 3000}, {50000, 500}, {60000, 500}, {90000, 4000}, {120000, 9000}});

TEST(BendCurve, RunsThroughItsDropsAndNeverBeyond) {
  const BendProfile bend(steps);
  for (std::size_t k = 0; k < steps.points.size(); ++k) {
    const double drop = *steps.points[k].drop_m;
    EXPECT_NEAR(bend.drop_m(steps.points[k].distance_m), drop, 1e-9);
    if (k == 0) continue;
    const double before = *steps.points[k - 1].drop_m;
    for (double d = steps.points[k - 1].distance_m; d < steps.points[k].distance_m; d += 250.0) {
      EXPECT_GE(bend.drop_m(d), std::min(drop, before) - 1e-9);
      EXPECT_LE(bend.drop_m(d), std::max(drop, before) + 1e-9);
      const double next = bend.drop_m(d + 250.0) - bend.drop_m(d);
      EXPECT_GE(next * (drop - before), 0.0)
          << "not monotone at " << d;  // level where two drops are equal
    }
  }
}

TEST(BendCurve, IsLevelAtAnExtremeOfItsDrops) {
  const BendProfile bend(drops({{0, 1000}, {10000, 0}, {20000, 300}}));
  EXPECT_EQ(bend.slope(10000.0), 0.0);
  for (double d = 0.0; d <= 20000.0; d += 100.0) EXPECT_GE(bend.drop_m(d), -1e-9) << d;
}

TEST(BendCurve, IsSmoothAtItsPointsAndStraightBeyond) {
  for (const BendCurve& curve :
       {steps, inclinations({{10000, 25}, {40000, 12}, {80000, 0}, {120000, -3}})}) {
    const BendProfile bend(curve);
    const double h = 0.5;
    for (const BendPoint& point : curve.points) {
      const double d = point.distance_m;
      const double before = (bend.drop_m(d) - bend.drop_m(d - h)) / h;
      const double after = (bend.drop_m(d + h) - bend.drop_m(d)) / h;
      EXPECT_NEAR(before, after, 1e-4) << d;
      EXPECT_NEAR(bend.slope(d), -0.5 * (before + after), 1e-4) << d;
    }
    EXPECT_DOUBLE_EQ(bend.slope(0.0), bend.slope(curve.points.front().distance_m));
    EXPECT_DOUBLE_EQ(bend.slope(1e6), bend.slope(curve.points.back().distance_m));
  }
}

TEST(BendCurve, KeepsItsInclinations) {
  const BendCurve curve = inclinations({{10000, 25}, {40000, 12}, {80000, 0}, {120000, -3}});
  const BendProfile bend(curve);
  for (const BendPoint& point : curve.points) {
    EXPECT_NEAR(to_degrees(std::atan(bend.slope(point.distance_m))), *point.inclination_deg, 1e-9);
    // The derivative of the drop agrees.
    const double fall = bend.drop_m(point.distance_m + 1.0) - bend.drop_m(point.distance_m - 1.0);
    EXPECT_NEAR(to_degrees(std::atan(-fall / 2.0)), *point.inclination_deg, 1e-3);
  }
  // Level at 80 km, the highest point: drops count from there, and are positive on both sides.
  EXPECT_NEAR(bend.drop_m(80000.0), 0.0, 1e-9);
  EXPECT_GT(bend.drop_m(79000.0), 0.0);
  EXPECT_GT(bend.drop_m(81000.0), 0.0);
  // Beyond the steepest point, the inclination only decreases.
  for (double d = 10000.0; d < 120000.0; d += 500.0)
    EXPECT_GE(bend.slope(d), bend.slope(d + 500.0) - 1e-12);
}

TEST(BendCurve, CountsDropsFromTheHighestPlaceBetweenPoints) {
  const BendProfile bend(inclinations({{0, 10}, {100000, -20}}));
  double min = 1e9;
  for (double d = 0.0; d <= 100000.0; d += 10.0) min = std::min(min, bend.drop_m(d));
  EXPECT_NEAR(min, 0.0, 1e-3);
}

TEST(BendCurve, TwoInclinationsAreAParabola) {
  // Tangents that change linearly with distance integrate to a parabola of radius run / change.
  const double at_0 = to_degrees(std::atan(0.5));
  const BendProfile points(inclinations({{0, at_0}, {50000, 0.0}}));
  const BendProfile parabola(BendCurve{100000.0, 50000.0, 0.0, 0.0, {}});
  for (double d = 0.0; d <= 50000.0; d += 1000.0) {
    EXPECT_NEAR(points.drop_m(d), parabola.drop_m(d), 1e-6);
    EXPECT_NEAR(points.slope(d), parabola.slope(d), 1e-12);
  }
}

TEST(BendCurve, RefusesWhatIsNoCurve) {
  BendCurve both = steps;
  both.points[1].inclination_deg = 3.0;
  BendCurve mixed = steps;
  mixed.points[1] = {30000.0, std::nullopt, 3.0};
  BendCurve empty = steps;
  empty.points[2].drop_m.reset();
  BendCurve beside = steps;
  beside.radius_m = 1e5;
  for (const BendCurve& curve : {both, mixed, empty, beside, drops({{1000, 5}}),
                                 drops({{1000, 5}, {1000, 6}}), drops({{2000, 5}, {1000, 6}})}) {
    const Error error = test::error_of([&] { const BendProfile bend(curve); });
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_EQ(error.where().rfind("points.", 0), 0U);
  }
}

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
