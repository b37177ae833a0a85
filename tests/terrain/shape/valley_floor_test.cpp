#include "terrain/shape/valley_floor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace belvedere {
namespace {

constexpr double floor_cell_m = 50.0;
constexpr int centre = 60;

// A valley that runs south: a level floor 2 km wide at 500 m, flanks that rise 1 in 2 to 1000 m,
// level ground beyond.
Grid<float> trough() {
  Grid<float> ground(121, 60);
  for (int y = 0; y < ground.height(); ++y)
    for (int x = 0; x < ground.width(); ++x)
      ground(x, y) =
          500.F + 25.F * static_cast<float>(std::clamp(std::abs(x - centre) - 20, 0, 20));
  return ground;
}

int count(const Grid<std::uint8_t>& marks) {
  return std::accumulate(marks.begin(), marks.end(), 0);
}

TEST(ValleyFloor, IsTheLevelGroundBetweenTheFlanks) {
  const Grid<std::uint8_t> floor = find_valley_floor(trough(), floor_cell_m);
  for (int x = 0; x < 121; ++x) {
    const int off = std::abs(x - centre);
    if (off <= 18) {
      EXPECT_EQ(floor(x, 30), 1) << x;
    }
    if (off >= 22) {
      EXPECT_EQ(floor(x, 30), 0) << x << ": flank or height";
    }
  }
}

TEST(ValleyFloor, APlainIsNone) {
  EXPECT_EQ(count(find_valley_floor(Grid<float>(121, 60, 500.F), floor_cell_m)), 0);
  EXPECT_EQ(count(find_valley_floor(trough(), floor_cell_m, {.below_highest_m = 501.0})), 0)
      << "the heights are only 500 m higher";
}

TEST(ValleyFloor, ALevelTerraceAboveItIsNone) {
  Grid<float> ground = trough();
  for (int y = 0; y < ground.height(); ++y)
    for (int x = 46; x < 54; ++x) ground(x, y) = 600.F;
  EXPECT_EQ(find_valley_floor(ground, floor_cell_m)(50, 30), 0);
  EXPECT_EQ(find_valley_floor(ground, floor_cell_m, {.above_lowest_m = 120.0})(50, 30), 1);
}

TEST(ValleyFloor, GentleSlopesCountAsFarAsAllowed) {
  Grid<float> ground = trough();
  for (int y = 0; y < ground.height(); ++y)
    for (int x = 0; x < ground.width(); ++x)
      ground(x, y) += 2.5F * static_cast<float>(y);  // atan(2.5 / 50) = 2.9°
  EXPECT_EQ(find_valley_floor(ground, floor_cell_m)(centre, 30), 1);
  EXPECT_EQ(find_valley_floor(ground, floor_cell_m, {.steepest_deg = 2.5})(centre, 30), 0);
}

TEST(ValleyFloor, VoidsAreNoneAndTakeNothingFromWhatLiesFarOff) {
  Grid<float> ground = trough();
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < ground.width(); ++x) ground(x, y) = NAN;
  const Grid<std::uint8_t> floor = find_valley_floor(ground, floor_cell_m);
  EXPECT_EQ(floor(centre, 3), 0);
  EXPECT_EQ(floor(centre, 40), 1);
}

}  // namespace
}  // namespace belvedere
