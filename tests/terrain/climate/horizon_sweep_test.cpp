#include "terrain/climate/horizon_sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/math.h"
#include "base/random.h"

namespace belvedere {
namespace {

TEST(HorizonSweep, AWallStandsAsHighAsItIsFarFromAnyDirection) {
  // A straight wall, perpendicular to the view: its tangent is height / distance, minus earth
  // curvature.
  constexpr double cell_m = 50.0;
  for (const double azimuth : {0.0, 90.0, 180.0, 270.0}) {
    Grid<float> ground(301, 301, 100.0F);
    const bool upright = azimuth == 90.0 || azimuth == 270.0;
    for (int i = 0; i < 301; ++i) (upright ? ground(150, i) : ground(i, 150)) = 600.0F;
    const Grid<float> tangents = horizon_tangents(ground, {cell_m, cell_m}, azimuth);
    for (const int away : {1, 7, 100}) {
      const int from = azimuth == 90.0 || azimuth == 0.0 ? -1 : 1;
      const int x = upright ? 150 + from * away : 120;
      const int y = upright ? 120 : 150 - from * away;
      const double distance = away * cell_m;
      EXPECT_NEAR(tangents(x, y), 500.0 / distance - distance / (2.0 * sight_radius_m),
                  2e-6 * (1.0 + 500.0 / distance))
          << azimuth << ' ' << away;
    }
  }
}

TEST(HorizonSweep, FarMountainsSinkBehindTheEarth) {
  // 4000 m above the sea, 150 km away: 1535 m are hidden.
  constexpr int width = 1600;
  Grid<float> sea(width, 3, 0.0F);
  for (int y = 0; y < 3; ++y) sea(1550, y) = 4000.0F;
  const Grid<float> tangents = horizon_tangents(sea, {100.0, 100.0}, 90.0);
  EXPECT_NEAR(tangents(50, 1), (4000.0 - 150e3 * 150e3 / (2.0 * sight_radius_m)) / 150e3, 1e-6);
}

TEST(HorizonSweep, AnyDirectionOnSmoothHillsIsWhatMarchingFinds) {
  constexpr int size = 160;
  Grid<float> hills(size, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      hills(x, y) = static_cast<float>(300.0 * std::sin(x / 11.0) * std::cos(y / 13.0) + 4.0 * x);
  const auto height = [&](double x, double y) {
    const int x0 = std::min(static_cast<int>(x), size - 2);
    const int y0 = std::min(static_cast<int>(y), size - 2);
    const double fx = x - x0;
    const double fy = y - y0;
    return (hills(x0, y0) * (1 - fx) + hills(x0 + 1, y0) * fx) * (1 - fy) +
           (hills(x0, y0 + 1) * (1 - fx) + hills(x0 + 1, y0 + 1) * fx) * fy;
  };
  constexpr double cell_x = 30.0;
  constexpr double cell_y = 25.0;  // cells need not be square
  for (const double azimuth : {10.0, 77.0, 143.0, 200.0, 301.0, 350.0}) {
    const Grid<float> tangents = horizon_tangents(hills, {cell_x, cell_y}, azimuth);
    const double east = std::sin(to_radians(azimuth));
    const double north = std::cos(to_radians(azimuth));
    for (int y = 30; y < 130; y += 9)
      for (int x = 30; x < 130; x += 9) {
        double highest = -9.0;
        for (double t = 5.0;; t += 5.0) {
          const double px = x + t * east / cell_x;
          const double py = y - t * north / cell_y;
          if (px < 0 || py < 0 || px > size - 1 || py > size - 1) break;
          if (t >= cell_x)
            highest = std::max(highest,
                               (height(px, py) - hills(x, y) - t * t / (2.0 * sight_radius_m)) / t);
        }
        EXPECT_NEAR(tangents(x, y), highest, 0.025) << azimuth << ' ' << x << ' ' << y;
      }
  }
}

TEST(HorizonSweep, EveryCellIsSeenOnceAndTheRimOnThatSideSeesNothing) {
  Grid<float> ground(37, 23);
  for (std::size_t i = 0; i < ground.size(); ++i)
    ground[i] = static_cast<float>(random_uniform(1, static_cast<int>(i), 0) * 100.0);
  for (int azimuth = 0; azimuth < 360; azimuth += 15) {
    Grid<int> seen(37, 23, 0);
    sweep_horizon(ground, plan_sweep(37, 23, {30.0, 30.0}, exact::turn(to_radians(azimuth))),
                  [&](int x, int y, float) { ++seen(x, y); });
    for (const int count : seen) EXPECT_EQ(count, 1) << azimuth;
  }
  EXPECT_EQ(horizon_tangents(ground, {30.0, 30.0}, 0.0)(5, 0), no_horizon);
  EXPECT_EQ(horizon_tangents(ground, {30.0, 30.0}, 90.0)(36, 5), no_horizon);
  EXPECT_GT(horizon_tangents(ground, {30.0, 30.0}, 180.0)(5, 0), -4.0F);
}

TEST(HorizonSweep, VoidsHideNothing) {
  Grid<float> ground(60, 5, 0.0F);
  for (int y = 0; y < 5; ++y) {
    ground(40, y) = 1000.0F;
    ground(30, y) = std::numeric_limits<float>::quiet_NaN();
  }
  EXPECT_NEAR(horizon_tangents(ground, {100.0, 100.0}, 90.0)(20, 2), 0.5, 1e-3);
}

}  // namespace
}  // namespace belvedere
