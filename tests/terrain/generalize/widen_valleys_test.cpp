#include "terrain/generalize/widen_valleys.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>

#include "base/error.h"
#include "base/filter.h"
#include "base/parallel.h"
#include "terrain/io/raster_io.h"
#include "terrain/shape/hydrology.h"
#include "tests/grids.h"
#include "tests/paths.h"
#include "tests/terrain/generalize/synthetic_relief.h"

namespace belvedere {
namespace {

using test::cell_m;

// A valley along column 100 that falls to the south, walls of 27°, ridges 1350 m above it in
// columns 10 and 190; `floor_m` is the half-width of its flat floor.
Grid<float> make_valley(double floor_m) {
  Grid<float> grid(201, 300);
  for (const auto [x, y] : test::cells(grid)) {
    const double side = std::abs(x - 100.0);
    const double up = std::max(0.0, std::min(side, 180.0 - side) * cell_m - floor_m) * 0.5;
    grid(x, y) = static_cast<float>(1500.0 - 0.6 * y + up);
  }
  return grid;
}

WidenValleysParameters valleys_of(float width_m) {
  return {.width_m = width_m, .min_catchment_km2 = 4.F, .full_catchment_km2 = 6.F};
}

Grid<float> widen(const Grid<float>& altitude_m, const WidenValleysParameters& parameters,
                  const Grid<std::uint8_t>& keep = {}) {
  return widen_valleys(altitude_m, keep, {}, cell_m, parameters, silent_progress()).altitude_m;
}

// Width of the ground lower than `above_m` above the centreline in this row, m, between the walls'
// crossings.
double width_at(const Grid<float>& z, int row, double above_m) {
  const double level = z(100, row) + above_m;
  const auto crossing = [&](int step) {
    int x = 100;
    while (z(x + step, row) < level) x += step;
    return std::abs(x - 100) + (level - z(x, row)) / (z(x + step, row) - z(x, row));
  };
  return (crossing(-1) + crossing(1)) * cell_m;
}

double pit_volume(const Grid<float>& z) {
  const Grid<float> filled = fill_hollows(z);
  double sum = 0.0;
  for (std::size_t i = 0; i < z.size(); ++i) sum += filled[i] - z[i];
  return sum;
}

float largest_offset(const Grid<glm::vec2>& offsets) {
  float largest = 0.F;
  for (const glm::vec2& offset : offsets) largest = std::max(largest, glm::length(offset));
  return largest;
}

TEST(WidenValleys, OffReturnsTheInput) {
  EXPECT_EQ(widen(make_valley(0.0), valleys_of(0.F)), make_valley(0.0));
}

TEST(WidenValleys, TheFloorGrowsByTheWidthAskedFor) {
  for (const double floor_m : {0.0, 300.0}) {
    const Grid<float> valley = make_valley(floor_m);
    for (const float width_m : {240.F, 480.F}) {
      const Grid<float> out = widen(valley, valleys_of(width_m));
      EXPECT_NEAR(width_at(out, 200, 40.0) - width_at(valley, 200, 40.0), width_m, 0.1 * width_m)
          << floor_m;
      // High on the walls it changes less.
      EXPECT_LT(width_at(out, 200, 900.0) - width_at(valley, 200, 900.0), 0.5 * width_m);
    }
  }
}

TEST(WidenValleys, RidgesKeepHeightAndPlaceAndWallsHaveNoSteps) {
  const Grid<float> valley = make_valley(0.0);
  const Grid<float> out = widen(valley, valleys_of(480.F));
  // Away from the mouth, where the continuation of the valley is unknown.
  double lost = 0.0;
  for (int y = 60; y < 250; ++y) {
    lost = std::max(lost, static_cast<double>(std::abs(out(10, y) - valley(10, y))));
    EXPECT_EQ(std::max_element(out.row(y), out.row(y) + 100) - out.row(y), 10) << y;
  }
  EXPECT_LT(lost, 2.0);
  // Walls of 15 m per cell become steeper, but not cliffs.
  double steepest = 0.0;
  for (const auto [x, y] : test::cells({12, 60, 100, 270}))
    steepest = std::max(steepest, static_cast<double>(std::abs(out(x + 1, y) - out(x, y))));
  EXPECT_LT(steepest, 1.6 * 15.0);
}

TEST(WidenValleys, FloorsAreLevelAcrossAndDrain) {
  const Grid<float> valley = make_valley(0.0);
  const Grid<float> out = widen(valley, valleys_of(480.F));
  for (int y = 60; y < 260; ++y) {
    EXPECT_NEAR(out(97, y), out(103, y), 0.5);
    EXPECT_GT(out(100, y - 1), out(100, y)) << y;
  }
  EXPECT_LE(pit_volume(out), pit_volume(valley) + 1.0);
}

TEST(WidenValleys, LakesStay) {
  Grid<float> valley = make_valley(300.0);
  Grid<std::uint8_t> keep(valley.width(), valley.height());
  for (const auto [x, y] : test::cells({95, 140, 106, 160})) {
    keep(x, y) = 1;
    valley(x, y) = valley(100, 159);
  }
  const Grid<float> out = widen(valley, valleys_of(480.F), keep);
  for (std::size_t i = 0; i < out.size(); ++i)
    if (keep[i] != 0) {
      EXPECT_EQ(out[i], valley[i]);
    }
}

// Features on a lake and at its shores do not move.
TEST(WidenValleys, LinesByLakesStay) {
  const Grid<float> valley = make_valley(0.0);
  Grid<std::uint8_t> keep(valley.width(), valley.height());
  for (const auto [x, y] : test::cells({108, 140, 116, 160})) keep(x, y) = 1;
  const Grid<glm::vec2> ways =
      widen_valleys(valley, keep, {}, 30.0, valleys_of(480.F), silent_progress()).goes_to;
  EXPECT_GT(ways(112, 80).x, 7.F);
  EXPECT_EQ(ways(112, 150), glm::vec2(0.F));
  EXPECT_LT(glm::length(ways(117, 150)), 0.5F) << "the shore";
  EXPECT_GT(ways(112, 185).x, 7.F);
}

TEST(WidenValleys, EachCellKnowsWhereItsGroundCameFrom) {
  const Grid<float> valley = make_valley(0.0);
  Grid<std::uint8_t> keep(valley.width(), valley.height());
  keep(95, 100) = 1;
  const WidenedValleys wide =
      widen_valleys(valley, keep, {}, cell_m, valleys_of(480.F), silent_progress());
  ASSERT_TRUE(wide.came_from.same_size(valley));
  for (int y = 120; y < 240; y += 10) {
    // Features on the wall 12 cells from the centreline are now 8 cells farther away, half of 480
    // m.
    for (const int side : {-1, 1}) {
      EXPECT_NEAR(wide.came_from(100 + side * 20, y).x, -side * 8.0, 0.5) << y;
      EXPECT_NEAR(wide.came_from(100 + side * 20, y).y, 0.0, 0.5);
      // The new floor comes from the bank, not from the water.
      EXPECT_NEAR(5.0 * side + wide.came_from(100 + side * 5, y).x, 1.5 * side, 0.1);
      EXPECT_NEAR(glm::length(wide.came_from(100 + side, y)), 0.0, 0.0);
      EXPECT_NEAR(glm::length(wide.came_from(100 + side * 89, y)), 0.0, 0.1);  // the ridge
    }
    // On the walls the altitude moves with them.
    for (int x = 115; x < 185; ++x) {
      const glm::vec2 from = glm::vec2(x, y) + wide.came_from(x, y);
      EXPECT_NEAR(wide.altitude_m(x, y), sample_bilinear(valley, from.x, from.y), 8.0)
          << x << " " << y;
    }
  }
  EXPECT_EQ(wide.came_from(95, 100), glm::vec2(0.F));
  EXPECT_TRUE(
      widen_valleys(valley, {}, {}, cell_m, valleys_of(0.F), silent_progress()).came_from.empty());
}

TEST(WidenValleys, OneOrTwoThreadsAndFaults) {
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return widen(make_valley(150.0), valleys_of(300.F));
  };
  EXPECT_EQ(with(1), with(2));
  WidenValleysParameters parameters = valleys_of(100.F);
  parameters.fade_height = 0.F;
  EXPECT_THROW(widen(make_valley(0.0), parameters), Error);
  // No catchment is large enough: nothing changes.
  parameters = valleys_of(100.F);
  parameters.min_catchment_km2 = 9000.F;
  parameters.full_catchment_km2 = 10000.F;
  EXPECT_EQ(widen(make_valley(0.0), parameters), make_valley(0.0));
}

TEST(WidenValleys, ARealRangeKeepsItsSummitsAndGetsNoPits) {
  const std::string path = test::data_folder() + "/big_tujunga/bigtujunga.tif";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  RasterSource source;
  source.path = path;
  const Grid<float> whole = read_raster(source).cells;
  Grid<float> part = test::grid_of(400, 400, [&](int x, int y) { return whole(x + 400, y + 120); });
  WidenValleysParameters parameters;
  parameters.width_m = 400.F;
  const Grid<float> out = widen(part, parameters);
  EXPECT_LE(pit_volume(out), 1.05 * pit_volume(part));
  EXPECT_NEAR(*std::max_element(out.begin(), out.end()),
              *std::max_element(part.begin(), part.end()), 1.0);
  double moved = 0.0;
  for (std::size_t i = 0; i < out.size(); ++i) moved += std::abs(out[i] - part[i]);
  EXPECT_GT(moved / static_cast<double>(out.size()), 1.0);
}

TEST(WidenValleys, TheMaskKeepsTheGroundOfItsZerosAndHalvesThatOfAHalf) {
  const Grid<float> valley = make_valley(0.0);
  const auto masked = [&](const Grid<float>& mask) {
    return widen_valleys(valley, {}, mask, cell_m, valleys_of(480.F), silent_progress());
  };
  const WidenedValleys all = masked({});
  Grid<float> north(201, 300, 1.F);
  for (int y = 0; y < 120; ++y) std::fill_n(north.row(y), 201, 0.F);
  const WidenedValleys part = masked(north);
  for (const auto [x, y] : test::cells(201, 300)) {
    if (y < 120) {
      ASSERT_EQ(part.altitude_m(x, y), valley(x, y)) << x << ' ' << y;
      ASSERT_EQ(part.came_from(x, y), glm::vec2(0.F)) << x << ' ' << y;
      ASSERT_EQ(part.goes_to(x, y), glm::vec2(0.F)) << x << ' ' << y;
    } else if (y > 200) {
      ASSERT_NEAR(part.altitude_m(x, y), all.altitude_m(x, y), 0.05F) << x << ' ' << y;
    }
    // No step along the valley at the mask's edge: walls rise by 15 m from cell to cell.
    if (y > 0) {
      ASSERT_LT(std::abs(part.altitude_m(x, y) - part.altitude_m(x, y - 1)), 10.F) << x << ' ' << y;
    }
  }
  EXPECT_GT(largest_offset(all.goes_to), 3.F);
  const WidenedValleys half = masked(Grid<float>(201, 300, 0.5F));
  for (std::size_t i = 0; i < valley.size(); ++i)
    ASSERT_NEAR(half.altitude_m[i], 0.5F * (valley[i] + all.altitude_m[i]), 1e-3F);
}

// A valley along column 100 that falls to the south between walls of 27°, widened by 480 m.
Grid<glm::vec2> moves_of_a_valley(double river_wave = 0.0) {
  Grid<float> valley(201, 300);
  for (const auto [x, y] : test::cells(valley)) {
    const double side = std::abs(x - 100.0 - river_wave * std::sin(0.1 * y));
    valley(x, y) =
        static_cast<float>(1500.0 - 0.6 * y + std::min(side, 180.0 - side) * cell_m * 0.5);
  }
  const WidenValleysParameters parameters{
      .width_m = 480.F, .min_catchment_km2 = 4.F, .full_catchment_km2 = 6.F};
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
    for (const auto [x, y] : test::cells({10, 120, 190, 250})) {
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
