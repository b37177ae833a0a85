#include "terrain/shape/river_bends.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace belvedere {
namespace {

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
  Grid<float> out(bends_size, bends_size);
  for (int y = 0; y < bends_size; ++y)
    for (int x = 0; x < bends_size; ++x)
      out(x, y) =
          500.F + 15.F * static_cast<float>(std::max(0, std::abs(x - bends_size / 2) - cells));
  return out;
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

}  // namespace
}  // namespace belvedere
