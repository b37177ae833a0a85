#include "terrain/shape/valley_floor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "terrain/io/dem.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr double floor_cell_m = 50.0;
constexpr int centre = 60;

// A valley that runs south: a level floor 2 km wide at 500 m, flanks that rise 1 in 2 to 1000 m,
// level ground beyond.
Grid<float> trough() {
  return test::grid_of(121, 60, [&](int x, int) {
    return 500.F + 25.F * static_cast<float>(std::clamp(std::abs(x - centre) - 20, 0, 20));
  });
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
  for (const auto [x, y] : test::cells({46, 0, 54, ground.height()})) ground(x, y) = 600.F;
  EXPECT_EQ(find_valley_floor(ground, floor_cell_m)(50, 30), 0);
  EXPECT_EQ(find_valley_floor(ground, floor_cell_m, {.above_lowest_m = 120.0})(50, 30), 1);
}

TEST(ValleyFloor, GentleSlopesCountAsFarAsAllowed) {
  Grid<float> ground = trough();
  for (const auto [x, y] : test::cells(ground))
    ground(x, y) += 2.5F * static_cast<float>(y);  // atan(2.5 / 50) = 2.9°
  EXPECT_EQ(find_valley_floor(ground, floor_cell_m)(centre, 30), 1);
  EXPECT_EQ(find_valley_floor(ground, floor_cell_m, {.steepest_deg = 2.5})(centre, 30), 0);
}

TEST(ValleyFloor, VoidsAreNoneAndTakeNothingFromWhatLiesFarOff) {
  Grid<float> ground = trough();
  for (const auto [x, y] : test::cells(ground.width(), 6)) ground(x, y) = NAN;
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
  for (const auto [x, y] : test::cells(100, 80))
    dem.altitude_m(x, y) = static_cast<float>(plane(dem.transform.to_crs(x, y)));
  return dem;
}

TEST(Surroundings, LieAroundTheWindowAsFarAsAskedAndAsThereIs) {
  const Dem whole = whole_plane();
  const GeoTransform transform{50000.0 + 20 * 90.0, 90000.0 - 2 * 90.0, 30.0, 30.0};
  const Grid<float> own =
      test::grid_of(60, 45, [&](int x, int y) { return 1000.0 + plane(transform.to_crs(x, y)); });
  const Surrounded all = surround(own, transform, whole, 600.0);
  EXPECT_EQ(all.left, 20);
  EXPECT_EQ(all.top, 6) << "the whole ends there";
  EXPECT_EQ(all.altitude_m.width(), 20 + 60 + 20);
  EXPECT_EQ(all.altitude_m.height(), 6 + 45 + 20);
  for (const auto [x, y] : test::cells({0, 2, all.altitude_m.width(), all.altitude_m.height()})) {
    const double higher = own.contains(x - all.left, y - all.top) ? 1000.0 : 0.0;
    EXPECT_NEAR(all.altitude_m(x, y), higher + plane(all.transform.to_crs(x, y)), 0.02)
        << x << ' ' << y;
  }
}

using testing::ElementsAre;
using testing::FieldsAre;
using testing::IsEmpty;

// Ground of cones 10 m down a cell, the highest of them counts.
struct Cone {
  int x, y;
  float top_m;
};
Grid<float> cones(int width, int height, const std::vector<Cone>& tops) {
  Grid<float> ground(width, height, 0.F);
  for (const auto [x, y] : test::cells(width, height))
    for (const Cone& cone : tops)
      ground(x, y) = std::max(
          ground(x, y), cone.top_m - 10.F * static_cast<float>(std::max(std::abs(x - cone.x),
                                                                        std::abs(y - cone.y))));
  return ground;
}

// Two cones 20 cells apart, 300 and 200 m high: at the saddle both are as high, 300 - 10 a = 200 -
// 10 (20 - a), a = 15, at 150 m.
TEST(Summits, ProminenceIsHeightOverTheSaddleToHigherGround) {
  EXPECT_THAT(
      find_summits(cones(60, 40, {{15, 20, 300.F}, {35, 20, 200.F}}), {.min_prominence_m = 20.0}),
      ElementsAre(FieldsAre(15, 20, 300.F, 300.F), FieldsAre(35, 20, 200.F, 50.F)));
}

// Of three in a row the middle one's way to the highest leads over its own saddle, the last one's
// over both: the lower saddle counts.
TEST(Summits, TheWayGoesOverLowerSummits) {
  const std::vector<Summit> found =
      find_summits(cones(100, 40, {{20, 20, 300.F}, {50, 20, 200.F}, {70, 20, 260.F}}),
                   {.min_prominence_m = 20.0});
  // 300 - 10 a = 200 - 10 (30 - a): a = 20, 100 m; between the others 200 - 10 a = 260 - 10 (20 -
  // a): a = 7, 130 m.
  EXPECT_THAT(found, ElementsAre(FieldsAre(20, 20, 300.F, 300.F), FieldsAre(70, 20, 260.F, 160.F),
                                 FieldsAre(50, 20, 200.F, 70.F)));
}

TEST(Summits, LeastProminenceAndMostAreHeldTo) {
  const Grid<float> ground = cones(60, 40, {{15, 20, 300.F}, {35, 20, 200.F}});
  EXPECT_EQ(find_summits(ground, {.min_prominence_m = 50.0}).size(), 2U);
  EXPECT_EQ(find_summits(ground, {.min_prominence_m = 50.5}).size(), 1U);
  EXPECT_EQ(find_summits(ground, {.min_prominence_m = 20.0, .max = 1}).front().altitude_m, 300.F);
}

TEST(Summits, GroundThatGoesOnBeyondTheDataIsNone) {
  EXPECT_THAT(find_summits(cones(40, 40, {{0, 20, 300.F}})), IsEmpty());
  Grid<float> ground = cones(40, 40, {{20, 20, 300.F}});
  EXPECT_EQ(find_summits(ground).size(), 1U);
  ground(21, 20) = NAN;
  EXPECT_THAT(find_summits(ground, {.min_prominence_m = 150.0}), IsEmpty());
}

TEST(Summits, LevelTopsAreOneAndLevelLandHasNone) {
  Grid<float> ground = cones(40, 40, {{20, 20, 300.F}});
  ground(21, 20) = ground(20, 21) = ground(21, 21) = 300.F;
  EXPECT_THAT(find_summits(ground), ElementsAre(FieldsAre(20, 20, 300.F, 200.F)))
      << "the corner is 20 cells away";
  EXPECT_THAT(find_summits(Grid<float>(20, 20, 500.F)), IsEmpty());
  EXPECT_THAT(find_summits(Grid<float>()), IsEmpty());
}

TEST(Summits, LandBelowTheSeaRanksByItsHeight) {
  Grid<float> ground = cones(60, 40, {{15, 20, 300.F}, {35, 20, 200.F}});
  for (float& z : ground) z -= 400.F;
  EXPECT_THAT(find_summits(ground, {.min_prominence_m = 20.0}),
              ElementsAre(FieldsAre(15, 20, -100.F, 300.F), FieldsAre(35, 20, -200.F, 50.F)));
}

}  // namespace
}  // namespace belvedere
