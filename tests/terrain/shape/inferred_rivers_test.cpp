#include "terrain/shape/inferred_rivers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "terrain/shape/hydrology.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr double valley_cell_m = 30.0;
constexpr int rows = 200;
constexpr int river_column = 60;
const GeoTransform valley_transform{0.0, rows* valley_cell_m, valley_cell_m, valley_cell_m};

// A river down a column from `from_km2`, `step_km2` more in each row; a brook along row 100 from
// the west, of 25 … 31 km².
Grid<float> waters(double from_km2, double step_km2, bool brook = false) {
  Grid<float> km2(121, rows, 0.5F);
  for (int y = 0; y < rows; ++y) km2(river_column, y) = static_cast<float>(from_km2 + step_km2 * y);
  for (int x = 1; brook && x < river_column; ++x) km2(x, 100) = static_cast<float>(25.0 + 0.1 * x);
  return km2;
}
// Steep to both sides of the river.
Grid<float> valley() {
  return test::grid_of(121, rows, [&](int x, int y) {
    return 1000.F + 20.F * static_cast<float>(std::abs(x - river_column)) - static_cast<float>(y);
  });
}
RiverBed everywhere(int, int) { return RiverBed::runs; }
double row_of(glm::dvec2 position) { return valley_transform.to_cell(position.x, position.y).y; }

TEST(InferredRivers, ComeUpFromNothingAndGrowAsKnownRiversDo) {
  // Inside the ground, so that the beginning is a spring: 20 km² in row 40.
  const std::vector<RiverCentreline> centrelines =
      infer_rivers_of_ground(waters(0.0, 0.5), valley(), valley_transform, everywhere);
  ASSERT_EQ(centrelines.size(), 1U);
  const RiverCentreline& river = centrelines[0];
  ASSERT_EQ(river.positions.size(), river.half_width_m.size());
  EXPECT_NEAR(row_of(river.positions.front()), 40.0, 0.01);
  EXPECT_EQ(river.half_width_m.front(), 0.F);
  for (std::size_t i = 1; i < river.positions.size(); ++i) {
    EXPECT_NEAR(river.positions[i].x, valley_transform.to_crs(river_column, 0).x, 0.01);
    EXPECT_GE(river.half_width_m[i], river.half_width_m[i - 1]);
    EXPECT_LT(river.half_width_m[i] - river.half_width_m[i - 1], 1.0);
  }
  // 90 km² in row 180.
  const auto at = std::min_element(
      river.positions.begin(), river.positions.end(), [](glm::dvec2 a, glm::dvec2 b) {
        return std::abs(row_of(a) - 180.0) < std::abs(row_of(b) - 180.0);
      });
  EXPECT_NEAR(river.half_width_m[static_cast<std::size_t>(at - river.positions.begin())],
              known_half_width_m(90.0), 0.05);
}

TEST(InferredRivers, KeepTheirWidthAtTheRimOfTheGround) {
  const RiverCentreline river =
      infer_rivers_of_ground(waters(100.0, 0.1), valley(), valley_transform, everywhere).at(0);
  EXPECT_NEAR(river.half_width_m.front(), known_half_width_m(100.0), 0.05);
  EXPECT_NEAR(river.half_width_m.back(), known_half_width_m(119.9), 0.05);
}

TEST(InferredRivers, FadeWhereTheirBedIsDryAndCloseShortGaps) {
  const auto dry_between = [](int from, int to) {
    return [=](int, int y) { return y >= from && y < to ? RiverBed::dry : RiverBed::runs; };
  };
  const InferredRiverParameters usual;
  const std::vector<RiverCentreline> one = infer_rivers_of_ground(
      waters(100.0, 0.1), valley(), valley_transform, dry_between(90, 90 + usual.closed_cells));
  EXPECT_EQ(one.size(), 1U) << "a step in the ground is no end of a river";
  const std::vector<RiverCentreline> two =
      infer_rivers_of_ground(waters(100.0, 0.1), valley(), valley_transform, dry_between(90, 110));
  ASSERT_EQ(two.size(), 2U);
  EXPECT_NEAR(row_of(two[0].positions.back()), 89.0, 0.01);
  EXPECT_EQ(two[0].half_width_m.back(), 0.F);
  EXPECT_EQ(two[1].half_width_m.front(), 0.F);
  EXPECT_GT(two[1].half_width_m.back(), 15.F);
  EXPECT_TRUE(infer_rivers_of_ground(
                  waters(100.0, 0.1), valley(), valley_transform,
                  [](int, int y) { return y / 8 % 2 == 0 ? RiverBed::runs : RiverBed::dry; })
                  .empty())
      << "pieces shorter than min_cells";
}

TEST(InferredRivers, EndInLakesAndBeginThereAtTheirWidth) {
  const std::vector<RiverCentreline> centrelines = infer_rivers_of_ground(
      waters(100.0, 0.1), valley(), valley_transform,
      [](int, int y) { return y >= 80 && y < 120 ? RiverBed::open : RiverBed::runs; });
  ASSERT_EQ(centrelines.size(), 2U);
  EXPECT_NEAR(row_of(centrelines[0].positions.back()), 81.0, 0.01) << "two cells into it";
  EXPECT_NEAR(centrelines[0].half_width_m.back(), known_half_width_m(108.0), 0.1);
  EXPECT_NEAR(row_of(centrelines[1].positions.front()), 118.0, 0.01);
  EXPECT_NEAR(centrelines[1].half_width_m.front(), known_half_width_m(112.0), 0.1);
}

TEST(InferredRivers, KeepToTheirCourseWhereTheyFlowIntoALargerRiver) {
  std::vector<RiverCentreline> centrelines =
      infer_rivers_of_ground(waters(200.0, 0.1, true), valley(), valley_transform, everywhere);
  ASSERT_EQ(centrelines.size(), 2U);
  const bool brook_first = centrelines[0].positions.front().x < centrelines[1].positions.front().x;
  const RiverCentreline& brook = brook_first ? centrelines[0] : centrelines[1];
  const double river_x = valley_transform.to_crs(river_column, 0).x;
  EXPECT_NEAR(brook.positions.back().x, river_x, 0.01) << "on its middle";
  // Two cells below where its water does, in row 99: the flank is too steep for more.
  EXPECT_NEAR(row_of(brook.positions.back()), 101.0, 0.1);
  for (const glm::dvec2 position : brook.positions)
    EXPECT_NEAR(row_of(position), 100.0, 1.5) << "it does not cross the flank aslant";
  // It keeps its own width to the end, not the larger one's.
  EXPECT_LT(brook.half_width_m.back(), 7.F);
  EXPECT_GT(brook.half_width_m.back(), 2.F);
}

TEST(InferredRivers, BendOnLevelGroundAndBrooksFollowThem) {
  const Grid<float> plain(121, rows, 500.F);
  std::vector<RiverCentreline> centrelines =
      infer_rivers_of_ground(waters(200.0, 0.1, true), plain, valley_transform, everywhere);
  ASSERT_EQ(centrelines.size(), 2U);
  const bool brook_first = centrelines[0].positions.front().x < centrelines[1].positions.front().x;
  const RiverCentreline& brook = brook_first ? centrelines[0] : centrelines[1];
  const RiverCentreline& river = brook_first ? centrelines[1] : centrelines[0];
  double off_m = 0.0;
  for (const glm::dvec2 position : river.positions)
    off_m = std::max(off_m, std::abs(position.x - valley_transform.to_crs(river_column, 0).x));
  EXPECT_GT(off_m, 30.0);
  double mouth_m = 1e9;
  for (const glm::dvec2 position : river.positions)
    mouth_m = std::min(mouth_m, glm::length(position - brook.positions.back()));
  EXPECT_LT(mouth_m, 1.0);
  EXPECT_GT(row_of(brook.positions.back()), 104.0) << "farther down than the water of the cells";
  for (std::size_t i = 1; i < brook.positions.size(); ++i)
    EXPECT_LT(glm::length(brook.positions[i] - brook.positions[i - 1]), 2.5 * valley_cell_m);
}

TEST(InferredRivers, JoinALargerOneBesideThemOnAFloorButNotBehindARidge) {
  // A brook comes from the west along row 20, runs down eight cells beside the river, and reaches
  // it in row 121.
  Grid<float> km2 = waters(200.0, 0.1);
  for (int x = 5; x < 52; ++x) km2(x, 20) = 25.F + 0.1F * static_cast<float>(x);
  for (int y = 20; y <= 120; ++y) km2(52, y) = 31.F + 0.1F * static_cast<float>(y);
  for (int x = 53; x < river_column; ++x) km2(x, 121) = 44.F + 0.1F * static_cast<float>(x - 53);
  const auto end_row = [&](const Grid<float>& ground) {
    const std::vector<RiverCentreline> rivers =
        infer_rivers_of_ground(km2, ground, valley_transform, everywhere);
    EXPECT_EQ(rivers.size(), 2U);
    double row = 0.0;
    for (const RiverCentreline& river : rivers)
      if (river.half_width_m.back() < 12.F) row = row_of(river.positions.back());
    return row;
  };
  const double joined = end_row(Grid<float>(121, rows, 500.F));
  EXPECT_GT(joined, 15.0);
  EXPECT_LT(joined, 50.0);
  const Grid<float> ridge =
      test::grid_of(121, rows, [](int x, int) { return x == 56 ? 520 : 500; });
  EXPECT_GT(end_row(ridge), 110.0);
}

// A valley that winds by 8 cells of 60 m every 60, dammed in row 200, whose course is known.
TEST(InferredRivers, BeginNarrowInTheLineOfTheirValleyAndFollowIt) {
  const auto axis = [](double y) {
    return 60.0 + 8.0 * std::sin(2.0 * 3.14159265358979 * y / 60.0);
  };
  const Grid<float> ground = test::grid_of(121, 300, [&](int x, int y) {
    const double off = x - axis(y);
    const double dam = std::abs(y - 200) < 2 ? 60.0 * std::exp(-off * off / 36.0) : 0.0;
    return 2000.0 - 3.0 * y + 12.0 * std::abs(off) + dam;
  });
  const GeoTransform transform{0.0, 300 * 60.0, 60.0, 60.0};
  const std::vector<RiverCentreline> rivers =
      infer_rivers_of_ground(flow_accumulation_km2(ground, 60.0), ground, transform, everywhere);
  ASSERT_EQ(rivers.size(), 1U);
  const RiverCentreline& river = rivers[0];
  EXPECT_LT(river.half_width_m.front(), 0.1F);
  EXPECT_GT(river.half_width_m.back(), 15.F);
  for (std::size_t i = 0; i < river.positions.size(); ++i) {
    const glm::dvec2 cell = transform.to_cell(river.positions[i].x, river.positions[i].y);
    EXPECT_NEAR(cell.x, axis(cell.y), 1.0) << "row " << cell.y;
    if (i > 0) {
      EXPECT_GE(river.half_width_m[i], river.half_width_m[i - 1]);
    }
  }
}

constexpr int bends_size = 400;
const GeoTransform bends_transform{500000.0, 5200000.0, 30.0, 30.0};

// Straight down the central column of the grid, or to its centre and then to the right.
RiverLine river(bool turns, double half_width_m) {
  RiverLine out;
  for (int k = 0; k < bends_size; ++k) {
    const bool right = turns && k > bends_size / 2;
    out.positions.emplace_back(right ? k : bends_size / 2, right ? bends_size / 2 : k);
    out.half_width_m.push_back(half_width_m);
    out.held.push_back(false);
  }
  return out;
}

// Level for that many cells to both sides of the central column, then steep.
Grid<float> floor_of(int cells) {
  return test::grid_of(bends_size, bends_size, [&](int x, int) {
    return 500.F + 15.F * static_cast<float>(std::max(0, std::abs(x - bends_size / 2) - cells));
  });
}

double length_of(const RiverLine& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.positions.size(); ++i)
    sum += glm::length(line.positions[i] - line.positions[i - 1]);
  return sum;
}

// The sharpest corner of a line, over two cells in each direction.
double sharpest(const RiverLine& line) {
  double min = 1.0;
  for (std::size_t i = 2; i + 2 < line.positions.size(); ++i)
    min = std::min(min, glm::dot(glm::normalize(line.positions[i] - line.positions[i - 2]),
                                 glm::normalize(line.positions[i + 2] - line.positions[i])));
  return min;
}

TEST(RiverBends, ARiverSwingsOnAPlainAndStaysInAGorge) {
  RiverLine on_plain = river(false, 20.0);
  bend_on_level_ground(on_plain, Grid<float>(bends_size, bends_size, 500.F), bends_transform, 1);
  EXPECT_GT(length_of(on_plain), 1.05 * bends_size);
  EXPECT_LT(length_of(on_plain), 1.8 * bends_size) << "it is no ball of wool";
  EXPECT_EQ(on_plain.positions.front(), glm::dvec2(bends_size / 2, 0));
  EXPECT_EQ(on_plain.positions.back(), glm::dvec2(bends_size / 2, bends_size - 1));
  RiverLine in_gorge = river(false, 20.0);
  bend_on_level_ground(in_gorge, floor_of(0), bends_transform, 1);
  EXPECT_EQ(in_gorge.positions, river(false, 20.0).positions);
}

TEST(RiverBends, BendsStayOnTheFloorOfTheirValley) {
  RiverLine line = river(false, 60.0);
  bend_on_level_ground(line, floor_of(9), bends_transform, 1);
  double off = 0.0;
  for (const glm::dvec2 position : line.positions)
    off = std::max(off, std::abs(position.x - bends_size / 2));
  EXPECT_GT(off, 2.0);
  EXPECT_LT(off, 9.0);
}

TEST(RiverBends, AreLargerOfLargerRivers) {
  const auto off = [](double half_width_m) {
    RiverLine line = river(false, half_width_m);
    bend_on_level_ground(line, Grid<float>(bends_size, bends_size, 500.F), bends_transform, 1);
    double sum = 0.0;
    for (const glm::dvec2 position : line.positions) sum += std::abs(position.x - bends_size / 2);
    return sum / bends_size;
  };
  EXPECT_GT(off(40.0), 1.3 * off(12.0));
}

TEST(RiverBends, RoundCornersOfCells) {
  RiverLine line = river(true, 20.0);
  ASSERT_LT(sharpest(line), 0.1) << "a right angle";
  bend_on_level_ground(line, Grid<float>(bends_size, bends_size, 500.F), bends_transform, 1);
  EXPECT_GT(sharpest(line), 0.5);
}

TEST(RiverBends, LakesHoldARiver) {
  RiverLine line = river(false, 20.0);
  for (std::size_t k = 150; k < 250; ++k) line.held[k] = true;
  bend_on_level_ground(line, Grid<float>(bends_size, bends_size, 500.F), bends_transform, 1);
  for (std::size_t k = 150; k < 250; ++k) EXPECT_EQ(line.positions[k].x, bends_size / 2) << k;
  EXPECT_NEAR(line.positions[149].x, bends_size / 2, 0.2) << "nor is there a step at its shore";
}

TEST(RiverBends, HangOnThePlaceAlone) {
  // The same river on a grid that begins 100 cells farther down.
  RiverLine whole = river(false, 20.0);
  bend_on_level_ground(whole, Grid<float>(bends_size, bends_size, 500.F), bends_transform, 1);
  RiverLine part = river(false, 20.0);
  part.positions.resize(bends_size - 100);
  part.half_width_m.resize(bends_size - 100);
  part.held.resize(bends_size - 100);
  GeoTransform moved = bends_transform;
  moved.origin_y -= 100 * bends_transform.cell_y;
  bend_on_level_ground(part, Grid<float>(bends_size, bends_size - 100, 500.F), moved, 1);
  for (std::size_t k = 80; k < 200; ++k)
    EXPECT_NEAR(part.positions[k].x, whole.positions[k + 100].x, 1e-6) << k;
}

// A river down column 20 whose catchment grows by .1 km² a row, and a brook that comes along row 30
// from the west.
Grid<float> two_waters() {
  Grid<float> km2(41, 60, 0.5F);
  for (int y = 0; y < 60; ++y)
    km2(20, y) = 50.F + 0.1F * static_cast<float>(y) + (y >= 30 ? 30.F : 0.F);
  for (int x = 0; x < 20; ++x) km2(x, 30) = 20.F + 0.1F * static_cast<float>(x);
  return km2;
}

TEST(RiverReaches, AreLinkedDownTheWater) {
  const std::vector<RiverReach> reaches = find_reaches(two_waters(), 20.0);
  ASSERT_EQ(reaches.size(), 80U);
  std::size_t springs = 0;
  std::size_t mouths = 0;
  for (std::size_t i = 0; i < reaches.size(); ++i) {
    springs += reaches[i].upstream == no_reach ? 1 : 0;
    mouths += reaches[i].downstream == no_reach ? 1 : 0;
    if (reaches[i].downstream == no_reach) continue;
    const RiverReach& below = reaches[reaches[i].downstream];
    EXPECT_GT(below.catchment_km2, reaches[i].catchment_km2);
    EXPECT_LE(std::hypot(below.position.x - reaches[i].position.x,
                         below.position.y - reaches[i].position.y),
              1.5);
    // Where two meet, the larger one is upstream.
    EXPECT_EQ(reaches[below.upstream].position.x == 20.0, below.position.x == 20.0);
  }
  EXPECT_EQ(springs, 2U);
  EXPECT_EQ(mouths, 1U);
  EXPECT_EQ(find_reaches(two_waters(), 40.0).size(), 60U) << "the river alone";
}

TEST(RiverReaches, LoseTheStairsOfTheGridButNotTheirEnds) {
  // One column on in three rows: stairs of a cell.
  Grid<float> km2(60, 90, 0.F);
  for (int y = 0; y < 90; ++y) km2(10 + y / 3, y) = 100.F + static_cast<float>(y);
  std::vector<RiverReach> reaches = find_reaches(km2, 50.0);
  for (RiverReach& reach : reaches) reach.half_width_m = reach.position.y < 45.0 ? 10.0 : 20.0;
  smooth_reaches(reaches);
  EXPECT_EQ(reaches.front().position, glm::dvec2(10.0, 0.0));
  EXPECT_EQ(reaches.back().position, glm::dvec2(39.0, 89.0));
  for (const RiverReach& reach : reaches)
    if (reach.position.y > 10.0 && reach.position.y < 79.0) {
      EXPECT_NEAR(reach.position.x, 10.0 + (reach.position.y - 1.0) / 3.0, 0.12);
    }
  for (std::size_t i = 1; i < reaches.size(); ++i)
    EXPECT_LT(std::abs(reaches[i].half_width_m - reaches[i - 1].half_width_m), 1.5);
}

TEST(RiverReaches, StayOnTheirLeash) {
  // Down a column, then along a row.
  Grid<float> km2(80, 80, 0.F);
  for (int k = 0; k < 40; ++k) {
    km2(20, k) = 100.F + static_cast<float>(k);
    km2(20 + k, 40) = 140.F + static_cast<float>(k);
  }
  const std::vector<RiverReach> cells = find_reaches(km2, 50.0);
  const auto moved = [&](const std::vector<double>& leashes) {
    std::vector<RiverReach> reaches = cells;
    smooth_reaches(reaches, leashes);
    double most = 0.0;
    for (std::size_t i = 0; i < cells.size(); ++i)
      most = std::max(most, glm::length(reaches[i].position - cells[i].position));
    return most;
  };
  EXPECT_GT(moved({}), 1.5);
  EXPECT_NEAR(moved(std::vector<double>(cells.size(), 0.8)), 0.8, 1e-9);
}

}  // namespace
}  // namespace belvedere
