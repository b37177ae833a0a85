#include "renderer/paint/ground/snow_relief.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr glm::dvec2 east{1.0, 0.0};
constexpr double metres_per_unit = 21.4;  // swells of exactly one octave, 256 m

// The offset is the gradient of a surface: two paths between the same points give the same rise.
TEST(SnowRelief, SlopesAreThoseOfASurface) {
  SnowRelief snow(7, east);
  // A small closed square: the sum of rises around it is negligible against the rises themselves.
  const double side_m = 160.0;
  const int steps = 400;
  double around = 0.0, up_and_down = 0.0;
  for (const auto [k, edge] : test::cells(steps, 4)) {
    const double t = (k + 0.5) / steps * side_m;
    const glm::dvec2 corner[4] = {{0, 0}, {side_m, 0}, {side_m, side_m}, {0, side_m}};
    const glm::dvec2 way[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    const glm::dvec2 position = corner[edge] + way[edge] * t;
    const glm::dvec2 slope(snow.at(glm::dvec2(4300.0, 1900.0) + position, metres_per_unit, 0.2)
                               .slope);  // swells alone: too small for drifts
    const double rise = glm::dot(slope, way[edge]) * side_m / steps;
    around += rise;
    up_and_down += std::abs(rise);
  }
  EXPECT_GT(up_and_down, 0.0);
  EXPECT_LT(std::abs(around), 0.15 * up_and_down);
}

TEST(SnowRelief, IsAsSteepNearAsFarAndSharpAtCrests) {
  for (const double metres : {3.0, 21.4, 80.0}) {
    SnowRelief snow(3, east);
    double squares = 0.0, sharpest = 0.0, mean_change = 0.0;
    glm::vec2 before(0.0F);
    const int positions = 6000;
    for (int k = 0; k < positions; ++k) {
      const SnowForm form = snow.at({1000.0 + k * metres * 0.5, 777.0 * metres}, metres, 2.0);
      squares += static_cast<double>(glm::dot(form.slope, form.slope));
      const auto change = static_cast<double>(glm::length(form.slope - before));
      if (k > 0) sharpest = std::max(sharpest, change), mean_change += change / positions;
      before = form.slope;
    }
    const double slope = std::sqrt(squares / positions);
    EXPECT_GT(slope, 0.08) << metres;
    EXPECT_LT(slope, 0.45) << metres;
    EXPECT_GT(sharpest, 5.0 * mean_change) << "flanks are planes, crests are edges";
  }
}

TEST(SnowRelief, DriftsLieAcrossTheWind) {
  SnowRelief snow(5, east);
  double along = 0.0, across = 0.0;
  for (const auto [x, y] : test::cells(60, 60)) {
    const glm::vec2 slope = snow.at({x * 170.0, y * 230.0}, metres_per_unit, 1.0).slope;
    along += static_cast<double>(slope.x * slope.x);
    across += static_cast<double>(slope.y * slope.y);
  }
  EXPECT_GT(along, 2.0 * across);
}

// Swells are the lower of two forms of deviation 1, the second of which is r = .35 higher: the mean
// of min(X, Y + r) is r (1 - Φ(r / √2)) - √2 φ(r / √2) = -.406. With half of r it would be -.481,
// with r = 0 -.564.
TEST(SnowRelief, TheSecondFormStandsHigher) {
  SnowRelief snow(11, east);
  double sum = 0.0;
  const int side = 160;
  for (const auto [x, y] :
       test::cells(side, side))  // several deviations apart; no multiple of the lattice
    sum += static_cast<double>(snow.at({x * 1571.0, y * 2718.0}, metres_per_unit, 0.2).height);
  EXPECT_NEAR(sum / (side * side), -0.406, 0.03);
}

TEST(SnowRelief, IsAFunctionOfPlaceAlone) {
  SnowRelief one(9, east), other(9, east), another_seed(10, east);
  const glm::dvec2 position(690123.0, 5249456.0);
  for (int k = 0; k < 500; ++k)
    one.at({690000.0 + 17.0 * k, 5249000.0 - 31.0 * k}, 10.0 + 0.1 * k, 1.0);
  const SnowForm a = one.at(position, 22.0, 1.0);
  const SnowForm b = other.at(position, 22.0, 1.0);
  EXPECT_EQ(a.slope, b.slope);
  EXPECT_EQ(a.height, b.height);
  EXPECT_NE(another_seed.at(position, 22.0, 1.0).slope, a.slope);
}

}  // namespace
}  // namespace belvedere
