#include "terrain/shape/river_centrelines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "base/parallel.h"
#include "terrain/shape/hydrology.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr int width = 240;
constexpr int height = 160;
constexpr double river_cell_m = 30.0;

// A valley that winds from west to east and falls; its bottom lies at bottom_row.
double bottom_row(double x) { return 80.0 + 14.0 * std::sin(x / 23.0); }

Dem winding_valley() {
  Raster<float> raster;
  raster.cells = Grid<float>(width, height);
  raster.transform = {600000.0, 5200000.0, river_cell_m, river_cell_m};
  for (const auto [x, y] : test::cells(width, height)) {
    const double off = (y - bottom_row(x)) * river_cell_m;
    raster.cells(x, y) = static_cast<float>(1500.0 - 0.01 * x * river_cell_m +
                                            0.25 * std::abs(off) + 1e-5 * off * off);
  }
  return make_dem(std::move(raster));
}

struct Valley {
  Dem dem = winding_valley();
  Grid<float> km2 = flow_accumulation_km2(dem.altitude_m, river_cell_m);

  glm::dvec2 at(double x, double y) const { return dem.transform.to_crs(x, y); }
  // Distance from the bottom, m, of positions away from the ends.
  double farthest_m(const RiverCentreline& centreline) const {
    double max = 0.0;
    for (const glm::dvec2 position : centreline.positions) {
      const glm::dvec2 cell = dem.transform.to_cell(position.x, position.y);
      if (cell.x < 12.0 || cell.x > width - 12.0) continue;
      max = std::max(max, std::abs(cell.y - bottom_row(cell.x)) * river_cell_m);
    }
    return max;
  }
};

double sharpest_turn_deg(const RiverCentreline& centreline) {
  double max = 0.0;
  for (std::size_t i = 1; i + 1 < centreline.positions.size(); ++i) {
    const glm::dvec2 a = glm::normalize(centreline.positions[i] - centreline.positions[i - 1]);
    const glm::dvec2 b = glm::normalize(centreline.positions[i + 1] - centreline.positions[i]);
    max = std::max(max, std::acos(std::min(1.0, glm::dot(a, b))) * 180.0 / M_PI);
  }
  return max;
}

TEST(RiverCentrelines, ARoughLineFindsTheBottomOfItsValley) {
  const Valley valley;
  // Straight across the bends, up to 420 m from the bottom.
  const MappedRiver drawn{.positions = {valley.at(2, 80), valley.at(width - 3, 80)},
                          .snap_m = 600.0};
  const RiverCentrelines laid = snap_rivers({drawn}, valley.dem, valley.km2);
  ASSERT_EQ(laid.lines.size(), 1U);
  EXPECT_LT(valley.farthest_m(laid.lines[0]), 1.2 * river_cell_m);
  EXPECT_LT(sharpest_turn_deg(laid.lines[0]), 20.0) << "no stairs of the grid";
  EXPECT_LE(laid.max_moved_m, 600.0);
  EXPECT_GT(laid.max_moved_m, 300.0);
  // Downstream, whatever direction it was drawn in.
  EXPECT_LT(laid.lines[0].positions.front().x, laid.lines[0].positions.back().x);
  MappedRiver back = drawn;
  std::swap(back.positions[0], back.positions[1]);
  const RiverCentrelines turned = snap_rivers({back}, valley.dem, valley.km2);
  EXPECT_LT(turned.lines[0].positions.front().x, turned.lines[0].positions.back().x);
}

TEST(RiverCentrelines, NothingMovesFartherThanItMay) {
  const Valley valley;
  MappedRiver drawn{.positions = {valley.at(2, 80), valley.at(width - 3, 80)}, .snap_m = 90.0};
  EXPECT_LE(snap_rivers({drawn}, valley.dem, valley.km2).max_moved_m, 90.0 + 1e-6);
  drawn.snap_m = 0.0;
  EXPECT_LT(snap_rivers({drawn}, valley.dem, valley.km2).max_moved_m, 1e-6);
}

// Accurate map data stay unchanged: the bottom lies where they have the river.
TEST(RiverCentrelines, AGoodLineStays) {
  const Valley valley;
  MappedRiver drawn{.positions = {}, .snap_m = 150.0};
  for (int x = 2; x < width - 2; ++x) drawn.positions.push_back(valley.at(x, bottom_row(x)));
  const RiverCentrelines laid = snap_rivers({drawn}, valley.dem, valley.km2);
  EXPECT_LT(laid.max_moved_m, river_cell_m);
  EXPECT_LT(laid.mean_moved_m, 0.4 * river_cell_m);
}

TEST(RiverCentrelines, WidthsFollowTheCatchmentOrTheMap) {
  const Valley valley;
  MappedRiver drawn{.positions = {valley.at(2, 80), valley.at(width - 3, 80)}, .snap_m = 600.0};
  const RiverCentreline by_catchment = snap_rivers({drawn}, valley.dem, valley.km2).lines.at(0);
  for (std::size_t i = 0; i < by_catchment.positions.size(); ++i) {
    const double there = known_half_width_m(
        valley.km2(width - 8, static_cast<int>(std::lround(bottom_row(width - 8)))));
    EXPECT_LE(by_catchment.half_width_m[i], there * 1.05);
  }
  EXPECT_GT(by_catchment.half_width_m.back(), by_catchment.half_width_m.front());
  drawn.width_m = 70.0;
  const RiverCentreline by_map = snap_rivers({drawn}, valley.dem, valley.km2).lines.at(0);
  for (const float half : by_map.half_width_m) EXPECT_NEAR(half, 35.F, 1e-4F);
  drawn.width_m = 0.0;
  drawn.min_width_m = 24.0;
  const RiverCentreline seen = snap_rivers({drawn}, valley.dem, valley.km2).lines.at(0);
  for (const float half : seen.half_width_m) EXPECT_GE(half, 11.99F);
  // The formula equals that of inferred rivers at their full width.
  for (const double km2 : {110.0, 500.0, 1e5})
    EXPECT_NEAR(known_half_width_m(km2), river_half_width_m(km2), 0.02);
  EXPECT_GT(known_half_width_m(1.0), 1.0);
}

TEST(RiverCentrelines, PiecesOfOneRiverAreOneRiver) {
  const Valley valley;
  const std::vector<glm::dvec2> cuts = {valley.at(2, 80), valley.at(70, 80), valley.at(150, 80),
                                        valley.at(width - 3, 80)};
  const MappedRiver whole{.positions = cuts, .snap_m = 500.0};
  const RiverCentrelines one = snap_rivers({whole}, valley.dem, valley.km2);
  // In pieces, in any order, one of them turned.
  std::vector<MappedRiver> pieces;
  for (std::size_t i : {2U, 0U, 1U})
    pieces.push_back({.positions = {cuts[i], cuts[i + 1]}, .snap_m = 500.0});
  std::swap(pieces[1].positions[0], pieces[1].positions[1]);
  const RiverCentrelines joined = snap_rivers(pieces, valley.dem, valley.km2);
  EXPECT_EQ(joined.joined, 2U);
  ASSERT_EQ(joined.lines.size(), 1U);
  ASSERT_NEAR(static_cast<double>(joined.lines[0].positions.size()),
              static_cast<double>(one.lines[0].positions.size()), 2.0);
  EXPECT_LT(valley.farthest_m(joined.lines[0]), 1.2 * river_cell_m);
  // Other groups stay apart.
  pieces[2].group = 1;
  EXPECT_GT(snap_rivers(pieces, valley.dem, valley.km2).lines.size(), 1U);
  // A ring does not cause an endless loop.
  const MappedRiver a{.positions = {valley.at(20, 20), valley.at(40, 20), valley.at(40, 40)}};
  const MappedRiver b{.positions = {valley.at(40, 40), valley.at(20, 40), valley.at(20, 20)}};
  EXPECT_EQ(snap_rivers({a, b}, valley.dem, valley.km2).lines.size(), 1U);
}

TEST(RiverCentrelines, ATributaryFlowsIntoTheRiver) {
  const Valley valley;
  const MappedRiver river{.positions = {valley.at(2, 80), valley.at(width - 3, 80)},
                          .snap_m = 600.0};
  // Ends on the map's line, beyond the final position of the river.
  const MappedRiver brook{.positions = {valley.at(110, 10), valley.at(112, 80)}, .snap_m = 600.0};
  const RiverCentrelines laid = snap_rivers({river, brook}, valley.dem, valley.km2);
  ASSERT_EQ(laid.lines.size(), 2U);
  double nearest = 1e9;
  for (const glm::dvec2 position : laid.lines[0].positions)
    nearest = std::min(nearest, glm::distance(position, laid.lines[1].positions.back()));
  EXPECT_LT(nearest, 1e-6);
  EXPECT_LT(laid.lines[1].half_width_m.back(), 0.7F * laid.lines[0].half_width_m[110])
      << "before its mouth it does not feel the river";
}

TEST(RiverCentrelines, WhatLiesBesideTheGroundIsSaid) {
  const Valley valley;
  const MappedRiver away{.positions = {{0.0, 0.0}, {1.0, 1.0}}};
  const MappedRiver through{.positions = {valley.at(-400, 80), valley.at(50, 80),
                                          valley.at(60, -300), valley.at(100, -300),
                                          valley.at(110, 80)}};
  const RiverCentrelines laid = snap_rivers({away, through}, valley.dem, valley.km2);
  EXPECT_EQ(laid.outside, 1U);
  EXPECT_EQ(laid.lines.size(), 2U) << "it leaves and comes back";
  EXPECT_TRUE(snap_rivers({}, valley.dem, valley.km2).lines.empty());
}

TEST(RiverCentrelines, TheSameForAnyThreads) {
  const Valley valley;
  std::vector<MappedRiver> drawn;
  for (int i = 0; i < 40; ++i)
    drawn.push_back(
        {.positions = {valley.at(5 * i, 10), valley.at(5 * i + 7, 150)}, .snap_m = 200.0});
  const RiverCentrelines many = snap_rivers(drawn, valley.dem, valley.km2);
  const ThreadLimit one(1);
  const RiverCentrelines few = snap_rivers(drawn, valley.dem, valley.km2);
  ASSERT_EQ(many.lines.size(), few.lines.size());
  for (std::size_t i = 0; i < many.lines.size(); ++i)
    EXPECT_EQ(many.lines[i].positions, few.lines[i].positions);
}

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

const glm::dvec2 a{0.0, 0.0}, b{10.0, 0.0}, c{20.0, 5.0}, d{30.0, 5.0}, e{20.0, -9.0};

MappedRiver line(std::vector<glm::dvec2> positions, double width_m = 0.0, int group = 0) {
  return {.positions = std::move(positions), .width_m = width_m, .group = group};
}

TEST(JoinedRivers, PiecesFollowEachOtherInAnyOrderAndDirection) {
  const JoinedLines river = join_lines({line({c, d}, 4.0), line({b, a}, 9.0), line({b, c})});
  ASSERT_THAT(river.lines, SizeIs(1));
  const bool down = river.lines[0].positions.front() == a;
  if (down)
    EXPECT_THAT(river.lines[0].positions, ElementsAre(a, b, c, d));
  else
    EXPECT_THAT(river.lines[0].positions, ElementsAre(d, c, b, a));
  EXPECT_EQ(river.lines[0].width_m, 9.0) << "as wide as its widest piece";
  EXPECT_EQ(river.joined, 2U);
}

TEST(JoinedRivers, WhereThreeMeetAllEnd) {
  const JoinedLines fork = join_lines({line({a, b}), line({b, c}), line({b, e})});
  EXPECT_THAT(fork.lines, SizeIs(3));
  EXPECT_EQ(fork.joined, 0U);
}

TEST(JoinedRivers, OtherGroupsAreOtherRivers) {
  EXPECT_THAT(join_lines({line({a, b}, 0.0, 1), line({b, c}, 0.0, 2)}).lines, SizeIs(2));
  EXPECT_THAT(join_lines({line({a, b}, 0.0, 1), line({b, c}, 0.0, 1)}).lines, SizeIs(1));
}

TEST(JoinedRivers, ARingEndsWhereItBegan) {
  const JoinedLines ring = join_lines({line({a, b, c}), line({c, e, a})});
  ASSERT_THAT(ring.lines, SizeIs(1));
  EXPECT_EQ(ring.lines[0].positions.front(), ring.lines[0].positions.back());
  EXPECT_THAT(ring.lines[0].positions, SizeIs(5));
  // A closed line has no continuation.
  EXPECT_THAT(join_lines({line({a, b, c, a})}).lines,
              ElementsAre(::testing::Field(&MappedRiver::positions, ElementsAre(a, b, c, a))));
}

TEST(JoinedRivers, PlacesWithoutALineAreLeftOut) {
  EXPECT_THAT(join_lines({line({a}), line({})}).lines, IsEmpty());
  EXPECT_THAT(join_lines({line({a, b}), line({b})}).lines, SizeIs(1));
}

}  // namespace
}  // namespace belvedere
