#include "terrain/generalize/moved_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "terrain/generalize/widen_valleys.h"

namespace belvedere {
namespace {

constexpr double cell_m = 30.0;

// A valley along column 100 that falls to the south between walls of 27°, widened by 480 m.
Grid<glm::vec2> moves_of_a_valley() {
  Grid<float> valley(201, 300);
  for (int y = 0; y < valley.height(); ++y)
    for (int x = 0; x < valley.width(); ++x) {
      const double side = std::abs(x - 100.0);
      valley(x, y) = static_cast<float>(1500.0 - 0.6 * y + std::min(side, 180.0 - side) * cell_m * 0.5);
    }
  WidenValleysParameters parameters;
  parameters.width_m = 480.F;
  parameters.least_catchment_km2 = 4.F;
  parameters.full_catchment_km2 = 6.F;
  return widen_valleys(valley, {}, cell_m, parameters, silent_progress()).came_from;
}

TEST(MovedGround, WhereNothingMovedEveryPlaceIsItself) {
  const glm::dvec2 at(12.25, 7.5);
  EXPECT_EQ(drawn_cell({}, at), at);
  EXPECT_EQ(origin_cell({}, at), at);
  EXPECT_EQ(drawn_cell(Grid<glm::vec2>(40, 40), at), at);
}

TEST(MovedGround, AWallLiesAsFarOutAsTheValleyIsWider) {
  const Grid<glm::vec2> moves = moves_of_a_valley();
  for (const double row : {120.0, 160.5, 220.0}) {
    EXPECT_NEAR(drawn_cell(moves, {112.0, row}).x, 120.0, 0.6);
    EXPECT_NEAR(drawn_cell(moves, {88.0, row}).x, 80.0, 0.6);
    EXPECT_NEAR(drawn_cell(moves, {112.0, row}).y, row, 0.6);
    // Just beside the bank as well, where a new floor lies between; the water stays.
    EXPECT_NEAR(drawn_cell(moves, {102.5, row}).x, 110.5, 1.0);
    EXPECT_NEAR(drawn_cell(moves, {100.0, row}).x, 100.0, 1e-9);
  }
}

TEST(MovedGround, ThereAndBackIsTheSamePlace) {
  const Grid<glm::vec2> moves = moves_of_a_valley();
  double worst = 0.0;
  for (double y = 110.0; y < 250.0; y += 7.3)
    for (double x = 12.0; x < 189.0; x += 1.7) {
      if (std::abs(x - 100.0) < 2.0) continue;  // banks, of which the floor has many copies
      worst = std::max(worst, glm::length(origin_cell(moves, drawn_cell(moves, {x, y})) - glm::dvec2(x, y)));
    }
  EXPECT_LT(worst, 0.01);
}

}  // namespace
}  // namespace belvedere
