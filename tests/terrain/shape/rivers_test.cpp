// river_half_width_m and river_mask of terrain/shape/hydrology.h for given catchments.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "terrain/shape/hydrology.h"

namespace belvedere {
namespace {

// A river down the rows, at column(y) in row y, whose catchment hardly grows: 110 km² makes 36 m
// wide.
Grid<float> river_down(int width, int height, const std::function<int(int)>& column,
                       float catchment_km2 = 110.F) {
  Grid<float> area(width, height, 1.F);
  for (int y = 0; y < height; ++y)
    area(column(y), y) = catchment_km2 + 1e-4F * static_cast<float>(y);
  return area;
}

TEST(Rivers, GrowSteadilyWithTheCatchment) {
  EXPECT_NEAR(river_half_width_m(110.0), 18.0, 1e-9);
  EXPECT_NEAR(river_half_width_m(500.0), 36.0, 1e-9);
  EXPECT_EQ(river_half_width_m(75.0), 0.0);
  EXPECT_EQ(river_half_width_m(1e7), 90.0);
  double before = 0.0;
  for (double area = 60.0; area < 5000.0; area += 1.0) {
    const double here = river_half_width_m(area);
    EXPECT_GE(here, before);
    EXPECT_LE(here - before, 1.5) << area;  // no jump
    before = here;
  }
}

// Catchments of a river down a line of cells: `row(x)` for every column, growing to the east.
template <class F>
Grid<float> river_along(int width, int height, double from_km2, double to_km2, F&& row) {
  Grid<float> area(width, height, 1.F);
  int y = row(0);
  double step = 0.0;
  for (int x = 0; x < width; ++x) {
    const int next = row(x);
    for (; y != next; y += next > y ? 1 : -1)
      area(x, y) =
          static_cast<float>(from_km2 + (to_km2 - from_km2) * (step += 0.5) / (2.0 * width));
    area(x, y) = static_cast<float>(from_km2 + (to_km2 - from_km2) * (step += 0.5) / (2.0 * width));
  }
  return area;
}

TEST(Rivers, AreAsWideAsTheirCatchmentSays) {
  // A straight river of 500 km²: 72 m wide, on cells of 10 m.
  const Grid<float> mask =
      river_mask(river_along(60, 41, 500.0, 500.1, [](int) { return 20; }), 10.0);
  for (int x = 20; x < 40; ++x) {
    double width_m = 0.0;
    for (int y = 0; y < 41; ++y) width_m += 10.0 * mask(x, y);
    EXPECT_NEAR(width_m, 72.0, 0.5) << x;
    EXPECT_FLOAT_EQ(mask(x, 20), 1.F);
    EXPECT_FLOAT_EQ(mask(x, 30), 0.F);
  }
}

TEST(Rivers, ThinOnesCoverAPartOfTheirCells) {
  // 36 m of water, drawn 60 m wide to be visible, in cells of 200 m: three tenths, not nothing and
  // not a whole cell.
  const Grid<float> mask =
      river_mask(river_along(30, 9, 110.0, 110.1, [](int) { return 4; }), 200.0);
  EXPECT_NEAR(mask(15, 4), 0.3F, 0.01F);
  EXPECT_EQ(mask(15, 6), 0.F);
}

TEST(Rivers, HaveNoStairs) {
  // A line that falls one cell in five. The smoothed one must follow it without the steps.
  const auto line = [](double x) { return 10.0 + 0.2 * x; };
  const Grid<float> mask =
      river_mask(river_along(150, 50, 500.0, 501.0,
                             [&](int x) { return static_cast<int>(std::lround(line(x))); }),
                 30.0);
  double worst = 0.0;
  for (int x = 30; x < 120; ++x) {
    double sum = 0.0;
    double moment = 0.0;
    for (int y = 0; y < 50; ++y) {
      sum += mask(x, y);
      moment += y * static_cast<double>(mask(x, y));
    }
    worst = std::max(worst, std::abs(moment / sum - line(x)));
  }
  EXPECT_LT(worst, 0.15);  // the cells themselves are off by up to 0.5
}

TEST(Rivers, TributariesReachTheMainRiver) {
  // A T: a river of 600 km² along row 40, one of 200 km² down column 50 into it.
  Grid<float> area = river_along(100, 60, 600.0, 600.1, [](int) { return 40; });
  for (int x = 50; x < 100; ++x) area(x, 40) += 200.F;
  for (int y = 0; y < 40; ++y) area(50, y) = 200.F + 0.01F * static_cast<float>(y);
  const Grid<float> mask = river_mask(area, 30.0);
  for (int y = 5; y < 40; ++y)
    EXPECT_GT(*std::max_element(mask.row(y) + 45, mask.row(y) + 56), 0.5F) << y;
}

TEST(Rivers, SmallStreamsAreNone) {
  const Grid<float> mask =
      river_mask(river_along(50, 20, 20.0, 70.0, [](int) { return 10; }), 30.0);
  EXPECT_EQ(*std::max_element(mask.begin(), mask.end()), 0.F);
}

TEST(Rivers, AreTheShareOfEachCellThatTheyCover) {
  const Grid<float> coarse = river_mask(river_down(21, 30, [](int) { return 10; }), 100.0);
  EXPECT_NEAR(coarse(10, 15), 0.6, 1e-3) << "36 m, drawn 60 m wide, of a cell of 100 m";
  EXPECT_EQ(coarse(9, 15), 0.F);
  const Grid<float> fine = river_mask(river_down(21, 30, [](int) { return 10; }), 25.0);
  // From the centreline 12.5 m, 37.5 m and 62.5 m: cells end there, the river at 18 m.
  EXPECT_NEAR(fine(10, 15), 1.0, 1e-3);
  EXPECT_NEAR(fine(11, 15), 0.22, 1e-3);
  EXPECT_NEAR(fine(9, 15), 0.22, 1e-3);
  EXPECT_EQ(fine(12, 15), 0.F);
}

// A grid's path to the south-south-east goes in steps of one and two; smoothed it is the straight
// line x = y / 2 - 1/4.
TEST(Rivers, ASmoothedPathIsAStraightLine) {
  constexpr double cell_m = 50.0;
  const Grid<float> mask = river_mask(river_down(60, 100, [](int y) { return y / 2; }), cell_m);
  for (int y = 40; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      const double distance_m = std::abs(x - (0.5 * y - 0.25)) / std::sqrt(1.25) * cell_m;
      const double covered =
          std::min(distance_m + 0.5 * cell_m, 29.0) - std::max(distance_m - 0.5 * cell_m, -29.0);
      EXPECT_NEAR(mask(x, y), std::clamp(covered / cell_m, 0.0, 1.0), 2e-3) << x << ' ' << y;
    }
  }
}

TEST(Rivers, ATributaryDoesNotMoveItsRiver) {
  Grid<float> area = river_down(
      41, 40, [](int) { return 20; }, 300.F);
  const Grid<float> alone = river_mask(area, 50.0);
  for (int x = 0; x < 20; ++x) area(x, 20) = 110.F + 1e-4F * static_cast<float>(x);
  const Grid<float> both = river_mask(area, 50.0);
  for (int y = 0; y < 40; ++y)
    for (int x = 21; x < 41; ++x) ASSERT_EQ(both(x, y), alone(x, y)) << x << ' ' << y;
}

}  // namespace
}  // namespace belvedere
