#include "terrain/generalize/moved_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "terrain/generalize/widen_valleys.h"
#include "tests/terrain/generalize/synthetic_relief.h"

namespace belvedere {
namespace {

using test::cell_m;

// A valley along column 100 that falls to the south between walls of 27°, widened by 480 m.
Grid<glm::vec2> moves_of_a_valley(double river_wave = 0.0) {
  Grid<float> valley(201, 300);
  for (int y = 0; y < valley.height(); ++y)
    for (int x = 0; x < valley.width(); ++x) {
      const double side = std::abs(x - 100.0 - river_wave * std::sin(0.1 * y));
      valley(x, y) =
          static_cast<float>(1500.0 - 0.6 * y + std::min(side, 180.0 - side) * cell_m * 0.5);
    }
  WidenValleysParameters parameters;
  parameters.width_m = 480.F;
  parameters.min_catchment_km2 = 4.F;
  parameters.full_catchment_km2 = 6.F;
  return widen_valleys(valley, {}, {}, cell_m, parameters, silent_progress()).goes_to;
}

TEST(MovedGround, WhereNothingMovedEveryPlaceIsItself) {
  const glm::dvec2 at(12.25, 7.5);
  EXPECT_EQ(drawn_cell({}, at), at);
  EXPECT_EQ(origin_cell({}, at), at);
  EXPECT_EQ(drawn_cell(Grid<glm::vec2>(40, 40), at), at);
  EXPECT_EQ(origin_cell(Grid<glm::vec2>(40, 40), at), at);
  const glm::dvec2 far(1e300, -1e300);
  EXPECT_EQ(drawn_cell(Grid<glm::vec2>(40, 40), far), far);
}

TEST(MovedGround, AWallLiesAsFarOutAsTheValleyIsWiderAndTheWaterStays) {
  const Grid<glm::vec2> moves = moves_of_a_valley();
  for (const double row : {120.0, 160.5, 220.0}) {
    EXPECT_NEAR(drawn_cell(moves, {112.0, row}).x, 120.0, 0.6);
    EXPECT_NEAR(drawn_cell(moves, {88.0, row}).x, 80.0, 0.6);
    EXPECT_NEAR(drawn_cell(moves, {112.0, row}).y, row, 0.6);
    EXPECT_NEAR(drawn_cell(moves, {100.0, row}).x, 100.0, 0.3);
    EXPECT_NEAR(drawn_cell(moves, {5.0, row}).x, 5.0, 0.3) << "a ridge";
  }
}

// A road along the water stays connected: nothing jumps to the other side, or outwards by more than
// three times its distance.
TEST(MovedGround, BesideTheWaterGroundIsDrawnOutAndNotTorn) {
  for (const double wave : {0.0, 4.0}) {
    const Grid<glm::vec2> moves = moves_of_a_valley(wave);
    for (int y = 120; y < 250; ++y)
      for (int x = 10; x < 190; ++x) {
        const glm::dvec2 step_x = drawn_cell(moves, {x + 1.0, y}) - drawn_cell(moves, {x + 0.0, y});
        const glm::dvec2 step_y =
            drawn_cell(moves, {x + 0.0, y + 1.0}) - drawn_cell(moves, {x + 0.0, y});
        ASSERT_GT(step_x.x, 0.3) << wave << " " << x << " " << y;
        ASSERT_LT(step_x.x, 3.2) << wave << " " << x << " " << y;
        ASSERT_LT(std::abs(step_y.x), 1.2) << wave << " " << x << " " << y;
      }
  }
}

TEST(MovedGround, ThereAndBackIsTheSamePlace) {
  const Grid<glm::vec2> moves = moves_of_a_valley(4.0);
  double worst = 0.0;
  for (double y = 110.0; y < 250.0; y += 7.3)
    for (double x = 12.0; x < 189.0; x += 1.7)
      worst = std::max(
          worst, glm::length(origin_cell(moves, drawn_cell(moves, {x, y})) - glm::dvec2(x, y)));
  EXPECT_LT(worst, 0.01);
}

}  // namespace
}  // namespace belvedere
