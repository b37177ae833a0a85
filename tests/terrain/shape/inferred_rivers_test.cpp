#include "terrain/shape/inferred_rivers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

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
  Grid<float> out(121, rows);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < 121; ++x)
      out(x, y) =
          1000.F + 20.F * static_cast<float>(std::abs(x - river_column)) - static_cast<float>(y);
  return out;
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

TEST(InferredRivers, FlowAslantIntoTheLargerRiver) {
  std::vector<RiverCentreline> centrelines =
      infer_rivers_of_ground(waters(200.0, 0.1, true), valley(), valley_transform, everywhere);
  ASSERT_EQ(centrelines.size(), 2U);
  const bool brook_first = centrelines[0].positions.front().x < centrelines[1].positions.front().x;
  const RiverCentreline& brook = brook_first ? centrelines[0] : centrelines[1];
  const double river_x = valley_transform.to_crs(river_column, 0).x;
  EXPECT_NEAR(brook.positions.back().x, river_x, 0.01) << "on its middle";
  EXPECT_GT(row_of(brook.positions.back()), 104.0) << "farther down than the water of the cells";
  const glm::dvec2 way = brook.positions.back() - brook.positions[brook.positions.size() - 4];
  EXPECT_LT(way.y, -0.5 * glm::length(way)) << "down the river as well";
  EXPECT_GT(way.x, 0.5 * glm::length(way));
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
  for (std::size_t i = 1; i < brook.positions.size(); ++i)
    EXPECT_LT(glm::length(brook.positions[i] - brook.positions[i - 1]), 2.5 * valley_cell_m);
}

}  // namespace
}  // namespace belvedere
