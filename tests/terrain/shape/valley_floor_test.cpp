#include "terrain/shape/valley_floor.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
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

// A plane of 90 m cells, and a window of 30 m cells in it whose ground is 1000 m higher, so that
// the two can be distinguished.
double plane(glm::dvec2 position) { return 0.1 * position.x - 0.03 * position.y; }
Dem whole_plane() {
  Dem dem;
  dem.transform = {50000.0, 90000.0, 90.0, 90.0};
  dem.altitude_m = Grid<float>(100, 80);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 100; ++x)
      dem.altitude_m(x, y) = static_cast<float>(plane(dem.transform.to_crs(x, y)));
  return dem;
}

TEST(Surroundings, LieAroundTheWindowAsFarAsAskedAndAsThereIs) {
  const Dem whole = whole_plane();
  const GeoTransform transform{50000.0 + 20 * 90.0, 90000.0 - 2 * 90.0, 30.0, 30.0};
  Grid<float> own(60, 45);
  for (int y = 0; y < 45; ++y)
    for (int x = 0; x < 60; ++x)
      own(x, y) = static_cast<float>(1000.0 + plane(transform.to_crs(x, y)));
  const Surrounded all = surround(own, transform, whole, 600.0);
  EXPECT_EQ(all.left, 20);
  EXPECT_EQ(all.top, 6) << "the whole ends there";
  EXPECT_EQ(all.altitude_m.width(), 20 + 60 + 20);
  EXPECT_EQ(all.altitude_m.height(), 6 + 45 + 20);
  for (int y = 2; y < all.altitude_m.height(); ++y)
    for (int x = 0; x < all.altitude_m.width(); ++x) {
      const double higher = own.contains(x - all.left, y - all.top) ? 1000.0 : 0.0;
      EXPECT_NEAR(all.altitude_m(x, y), higher + plane(all.transform.to_crs(x, y)), 0.02)
          << x << ' ' << y;
    }
}

}  // namespace

}  // namespace belvedere
