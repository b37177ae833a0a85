#include "terrain/shape/hydrology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "base/filter.h"
#include "base/parallel.h"
#include "base/random.h"
#include "terrain/io/raster_io.h"
#include "tests/grids.h"
#include "tests/paths.h"

// river_half_width_m and river_mask of terrain/shape/hydrology.h for given catchments.

namespace belvedere {
namespace {

Grid<float> rough(int width, int height, std::uint64_t seed) {
  return test::grid_of(width, height,
                       [&](int x, int y) { return 1000.0 + 50.0 * random_uniform(seed, x, y); });
}

// Calls f(index, diagonal) for the neighbours of a cell.
void each_beside(const Grid<float>& grid, int x, int y, auto&& f) {
  for (int v = y - 1; v <= y + 1; ++v)
    for (int u = x - 1; u <= x + 1; ++u)
      if ((u != x || v != y) && grid.contains(u, v)) f(grid.index(u, v), u != x && v != y);
}

// The simplest flood: one heap for all cells.
Grid<float> flood_plainly(const Grid<float>& altitude_m) {
  const int width = altitude_m.width();
  const int height = altitude_m.height();
  Grid<float> level_m = altitude_m;
  Grid<std::uint8_t> wet(width, height, 0);
  std::set<std::pair<float, std::size_t>> rising;
  for (const auto [x, y] : test::cells(width, height)) {
    if (x > 0 && y > 0 && x < width - 1 && y < height - 1) continue;
    wet(x, y) = 1;
    rising.emplace(altitude_m(x, y), altitude_m.index(x, y));
  }
  while (!rising.empty()) {
    const std::size_t cell = rising.begin()->second;
    rising.erase(rising.begin());
    const int at = static_cast<int>(cell);
    each_beside(altitude_m, at % width, at / width, [&](std::size_t other, bool) {
      if (wet[other] != 0) return;
      wet[other] = 1;
      level_m[other] = std::max(level_m[other], level_m[cell]);
      rising.emplace(level_m[other], other);
    });
  }
  return level_m;
}

// The steepest neighbour of a cell, or the cell itself.
std::size_t steepest_of(const Grid<float>& level_m, int x, int y) {
  float steepest = 0.F;
  std::size_t to = level_m.index(x, y);
  each_beside(level_m, x, y, [&](std::size_t other, bool diagonal) {
    const float fall = level_m(x, y) - level_m[other];
    const float slope = diagonal ? fall * 0.70710678F : fall;
    if (slope > steepest) steepest = slope, to = other;
  });
  return to;
}

TEST(FlowAccumulation, IsThatOfAPlainFlood) {
  // Whole metres make flats, noise makes hollows in hollows; altitudes below zero, a rim higher
  // than the middle.
  for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
    for (const float step : {0.F, 1.F, 10.F, 25.F}) {
      Grid<float> ground = rough(83, 61, seed);
      for (const auto [x, y] : test::cells(83, 61)) {
        float& z = ground(x, y);
        z += 0.05F * static_cast<float>((x - 40) * (x - 40) + (y - 30) * (y - 30)) -
             (seed == 4 ? 1040.F : 0.F);
        if (step > 0.F) z = step * std::floor(z / step);
      }
      const Grid<float> level = flood_plainly(ground);
      EXPECT_EQ(fill_hollows(ground), level) << seed << ' ' << step;
      // Where ground falls, a cell has its own rain and that of those that fall into it; level
      // ground gives its water on to some of them. All leaves where nothing at the border is lower.
      const Grid<float> area = flow_accumulation_km2(ground, 1000.0);
      Grid<double> fallen(83, 61, 1.0);
      Grid<std::uint8_t> beside_level(83, 61, 0);
      double gone = 0.0;
      for (const auto [x, y] : test::cells(83, 61)) {
        const std::size_t cell = area.index(x, y);
        const std::size_t to = steepest_of(level, x, y);
        if (to != cell) {
          fallen[to] += static_cast<double>(area[cell]);
        } else if (x == 0 || y == 0 || x == 82 || y == 60) {
          gone += static_cast<double>(area[cell]);
        } else {
          beside_level[cell] = 1;
          each_beside(area, x, y, [&](std::size_t other, bool) { beside_level[other] = 1; });
        }
      }
      // Values grow downstream by a float's last bit if whole cells do not.
      for (std::size_t i = 0; i < area.size(); ++i) {
        ASSERT_GE(area[i], fallen[i] * (1.0 - 1e-5)) << seed << ' ' << step;
        if (beside_level[i] != 0) continue;
        ASSERT_LE(area[i], fallen[i] * (1.0 + 1e-5)) << seed << ' ' << step;
      }
      EXPECT_NEAR(gone, 83 * 61, 0.1) << seed << ' ' << step;
    }
  }
}

// The column of the largest catchment in a row.
int wettest_column(const Grid<float>& area, int y) {
  return static_cast<int>(std::max_element(area.row(y), area.row(y) + area.width()) - area.row(y));
}

TEST(FlowAccumulation, PassesADamAlongTheCourseOfItsValley) {
  // A valley that winds by 8 cells every 60, with a dam 60 m high in row 200: the water behind it
  // covers two bends and their flanks.
  const auto axis = [](int y) { return 60.0 + 8.0 * std::sin(2.0 * 3.14159265358979 * y / 60.0); };
  const Grid<float> valley = test::grid_of(121, 300, [&](int x, int y) {
    const double off = x - axis(y);
    const double dam = std::abs(y - 200) < 2 ? 60.0 * std::exp(-off * off / 36.0) : 0.0;
    return 2000.0 - 3.0 * y + 12.0 * std::abs(off) + dam;
  });
  const Grid<float> area = flow_accumulation_km2(valley, 60.0);
  for (int y = 60; y < 298; ++y) EXPECT_NEAR(wettest_column(area, y), axis(y), 1.0) << y;
}

TEST(FlowAccumulation, CrossesAFlatAlongItsMiddle) {
  // 17 cells wide and 80 long; water comes in beside its western edge and leaves in the south-east.
  const Grid<float> ground = test::grid_of(41, 90, [](int x, int y) {
    if (x == 13 && y < 5) return 102.0 - 0.1 * y;
    if (x == 27 && y >= 85) return 99.0 - 0.1 * (y - 85);
    const bool flat = std::abs(x - 20) <= 8 && y >= 5 && y < 85;
    return flat ? 100.0 : 110.0 + std::abs(x - 20);
  });
  const Grid<float> area = flow_accumulation_km2(ground, 1000.0);
  for (int y = 20; y < 70; ++y) EXPECT_NEAR(wettest_column(area, y), 20, 1) << y;
}

TEST(FlowAccumulation, OfATiltedPlaneCountsTheCellsAbove) {
  // Falls to the south: each column is a catchment of its own.
  Grid<float> plane(7, 50);
  for (const auto [x, y] : test::cells(7, 50)) plane(x, y) = 500.F - 3.F * static_cast<float>(y);
  const Grid<float> area = flow_accumulation_km2(plane, 1000.0);
  for (const auto [x, y] : test::cells(7, 50))
    EXPECT_FLOAT_EQ(area(x, y), static_cast<float>(y + 1)) << x << ' ' << y;
}

TEST(FlowAccumulation, OfAValleyGathersBothFlanks) {
  // Flanks 1 in 2, a floor that falls to the south: all water leaves through the floor's last cell.
  Grid<float> valley(61, 80);
  for (const auto [x, y] : test::cells(61, 80))
    valley(x, y) = 900.F - static_cast<float>(y) + 15.F * static_cast<float>(std::abs(x - 30));
  const Grid<float> area = flow_accumulation_km2(valley, 30.0);
  // Water runs off the flanks within a row or two, border cells keep theirs.
  EXPECT_NEAR(area(30, 79), 61 * 80 * 9e-4, 61 * 9e-4 * 1.5);
  EXPECT_NEAR(area(30, 40), 61 * 41 * 9e-4, 61 * 9e-4 * 25);
  for (int y = 1; y < 80; ++y) EXPECT_GT(area(30, y), area(30, y - 1));
}

TEST(FlowAccumulation, FillsAHollowToItsOutlet) {
  // A bowl in a plane, its edge breached at one position: all rain in the bowl leaves there.
  Grid<float> bowl(41, 41);
  for (const auto [x, y] : test::cells(41, 41))
    bowl(x, y) =
        std::hypot(static_cast<float>(x - 20), static_cast<float>(y - 20)) < 15.F ? 100.F : 200.F;
  for (int x = 34; x < 41; ++x) bowl(x, 20) = 150.F;
  const Grid<float> area = flow_accumulation_km2(bowl, 1000.0);
  const auto hollow = std::count_if(bowl.begin(), bowl.end(), [](float z) { return z < 160.F; });
  EXPECT_GE(area(40, 20), static_cast<float>(hollow));
  EXPECT_FLOAT_EQ(*std::max_element(area.begin(), area.end()), area(40, 20));
}

TEST(FlowAccumulation, EveryCellDrainsStrictlyDownstream) {
  // Noise is all hollows. Away from the border each cell has a neighbour with a larger catchment;
  // the total outflow of the grid is complete.
  const Grid<float> area = flow_accumulation_km2(rough(70, 55, 4), 1000.0);
  for (const auto [x, y] : test::cells({1, 1, 69, 54})) {
    bool drains = false;
    for (int v = y - 1; v <= y + 1; ++v)
      for (int u = x - 1; u <= x + 1; ++u) drains = drains || area(u, v) > area(x, y);
    ASSERT_TRUE(drains) << x << ' ' << y;
  }
  EXPECT_EQ(*std::min_element(area.begin(), area.end()), 1.F);
}

TEST(FlowAccumulation, LosesNoWater) {
  // Noise full of hollows inside a moat that falls towards one corner: all water must leave there,
  // to the last cell.
  Grid<float> ground = rough(50, 40, 6);
  for (const auto [x, y] : test::cells(50, 40))
    if (x == 0 || y == 0 || x == 49 || y == 39)
      ground(x, y) = 1.F + 0.5F * static_cast<float>(x + y);
  EXPECT_EQ(flow_accumulation_km2(ground, 1000.0)(0, 0), 2000.F);
  EXPECT_FLOAT_EQ(flow_accumulation_km2(ground, 50.0)(0, 0), 5.F);
}

// A lake of 30 × 20 cells whose banks rise by `bank_m` per cell.
Grid<float> with_lake(float level_m, float bank_m) {
  Grid<float> ground(80, 70);
  for (const auto [x, y] : test::cells(80, 70)) {
    const int dx = std::max({20 - x, x - 49, 0});
    const int dy = std::max({25 - y, y - 44, 0});
    ground(x, y) = level_m + bank_m * static_cast<float>(std::max(dx, dy));
  }
  return ground;
}

TEST(Lakes, AreFoundUpToTheirShore) {
  const Grid<std::uint8_t> lakes = find_lakes(with_lake(800.F, 1.F), {});
  int inside = 0;
  for (const auto [x, y] : test::cells(80, 70)) {
    const bool water = x >= 20 && x <= 49 && y >= 25 && y <= 44;
    if (!water) {
      EXPECT_EQ(lakes(x, y), 0) << x << ' ' << y;
    }
    inside += lakes(x, y);
  }
  // Opening with a cross rounds the four corners off, by three cells each.
  EXPECT_GE(inside, 30 * 20 - 4 * 3);
}

TEST(Lakes, NeedSizeAndFlatness) {
  const auto count = [](const Grid<std::uint8_t>& mask) {
    return std::count(mask.begin(), mask.end(), 1);
  };
  EXPECT_EQ(count(find_lakes(with_lake(800.F, 1.F), {.max_range_m = 0.25F, .min_cells = 700})), 0);
  Grid<float> ripples = with_lake(800.F, 1.F);
  for (const auto [x, y] : test::cells(80, 70)) ripples(x, y) += x % 2 == 0 ? 0.3F : 0.F;
  EXPECT_EQ(count(find_lakes(ripples, {})), 0);
  EXPECT_GT(count(find_lakes(ripples, {.max_range_m = 0.4F})), 500);
  // A channel three cells wide is not a lake, however long.
  Grid<float> channel(200, 30, 50.F);
  for (int x = 0; x < 200; ++x)
    for (int y = 14; y < 17; ++y) channel(x, y) = 40.F;
  for (const auto [x, y] : test::cells(200, 30))
    channel(x, y) += y < 14 || y > 16 ? static_cast<float>(std::abs(y - 15)) : 0.F;
  EXPECT_EQ(count(find_lakes(channel, {})), 0);
}

TEST(Lakes, StepsOfAFloodPlainAreNone) {
  // A plain that falls 1 m in 30 cells, stored in whole metres: flats of 30 × 60 cells.
  Grid<float> plain = test::grid_of(240, 60, [&](int x, int) { return 700 - x / 30; });
  const auto count = [](const Grid<std::uint8_t>& mask) {
    return std::count(mask.begin(), mask.end(), 1);
  };
  EXPECT_EQ(count(find_lakes(plain, {})), 0);
  EXPECT_GT(count(find_lakes(plain, {.min_bank_m = 0.F})), 5000);
  // Nor where a wall of rock stands on one side of them.
  for (const auto [x, y] : test::cells(240, 10)) plain(x, y) += 100.F * static_cast<float>(10 - y);
  const Grid<std::uint8_t> lakes = find_lakes(plain, {});
  // The last step lies at the border and may be one: the ground beyond it is unknown.
  for (int y = 0; y < 60; ++y) EXPECT_EQ(std::count(lakes.row(y), lakes.row(y) + 210, 1), 0) << y;
}

// Every third cell of the Tyrol DEM, voids filled from the nearest cell.
Grid<float> tyrol_90m() {
  const std::string path = test::data_folder() + "/innsbruck/innsbruck_utm32_30m.tif";
  if (!std::filesystem::exists(path)) return {};
  RasterSource source;
  source.path = path;
  const Raster<float> raster = read_raster(source);
  Grid<float> ground(raster.cells.width() / 3, raster.cells.height() / 3);
  Grid<std::uint8_t> known(ground.width(), ground.height());
  for (const auto [x, y] : test::cells(ground)) {
    ground(x, y) = raster.cells(3 * x + 1, 3 * y + 1);
    known(x, y) = std::isfinite(ground(x, y));
  }
  const Grid<std::int32_t> nearest = nearest_marked(known);
  Grid<float> filled = ground;
  for (std::size_t i = 0; i < ground.size(); ++i)
    filled[i] = ground[static_cast<std::size_t>(nearest[i])];
  return filled;
}

TEST(Hydrology, FindsTheInn) {
  const Grid<float> ground = tyrol_90m();
  if (ground.empty()) GTEST_SKIP() << "needs innsbruck/innsbruck_utm32_30m.tif";
  const Grid<float> area = flow_accumulation_km2(ground, 90.0);
  const auto mouth = static_cast<int>(std::max_element(area.begin(), area.end()) - area.begin());
  const int x = mouth % ground.width();
  const int y = mouth / ground.width();
  // It leaves at the eastern rim below Wörgl, about 507 m above the sea, with 2850 km² of this DEM
  // behind it at 30 m; low passes move some valleys from one side to the other when only every
  // third cell is left.
  EXPECT_EQ(x, ground.width() - 1);
  EXPECT_NEAR(y, 1961 / 3, 15);
  EXPECT_NEAR(ground(x, y), 507.F, 15.F);
  EXPECT_NEAR(area(x, y), 2950.F, 250.F);
  const Grid<float> rivers = river_mask(area, 90.0);
  EXPECT_GT(std::count_if(rivers.begin(), rivers.end(), [](float r) { return r > 0.5F; }), 2000);
}

TEST(Hydrology, SameBitsForAnyThreadCount) {
  const Grid<float> ground = rough(200, 150, 9);
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    const Grid<float> area = flow_accumulation_km2(ground, 2000.0);
    return std::tuple{area, river_mask(area, 30.0),
                      find_lakes(ground, {.max_range_m = 60.F, .min_bank_m = 0.F})};
  };
  EXPECT_EQ(run(1), run(2));
}

TEST(FlowAccumulation, WhatEntersAtTheRimIsCarriedDownstreamAlone) {
  // A valley that runs south, of cells of 1 km²; 250 km² come in at its head.
  Grid<float> valley(11, 30);
  for (const auto [x, y] : test::cells(11, 30))
    valley(x, y) = 500.F - 3.F * static_cast<float>(y) + 10.F * static_cast<float>(std::abs(x - 5));
  const Grid<float> own = flow_accumulation_km2(valley, 1000.0);
  const Grid<float> with = flow_accumulation_km2(valley, 1000.0, {{5, 0, 250.0}, {400, 3, 9.0}});
  for (const auto [x, y] : test::cells(11, 30))
    EXPECT_FLOAT_EQ(with(x, y), own(x, y) + (x == 5 ? 250.F : 0.F)) << x << ' ' << y;
}

TEST(Catchments, AreThoseOfTheDemWhoeverAsksAndHoweverOften) {
  Dem dem;
  dem.altitude_m = Grid<float>(50, 40);
  for (const auto [x, y] : test::cells(50, 40))
    dem.altitude_m(x, y) =
        500.F - 3.F * static_cast<float>(y) + std::abs(static_cast<float>(x) - 20.F);
  dem.transform = {0.0, 0.0, 100.0, 100.0};
  dem.entries = {{20, 0, 77.0}};
  const Grid<float> expected = flow_accumulation_km2(dem.altitude_m, 100.0, dem.entries);
  Catchments catchments(dem);
  EXPECT_EQ(catchments.km2(), expected);
  EXPECT_GT(catchments.km2()(20, 39), 77.F) << "rivers from beyond count";
  EXPECT_EQ(&catchments.km2(), &catchments.km2()) << "found once";
  EXPECT_EQ(catchments.take_km2(), expected);
  EXPECT_EQ(catchments.km2(), expected) << "computed again after they were taken";
}

// A river down the rows, at column(y) in row y, whose catchment hardly grows: 110 km² makes 36 m
// wide.
Grid<float> river_down(int width, int height, const std::function<int(int)>& column,
                       float catchment_km2 = 110.F) {
  Grid<float> area(width, height, 1.F);
  for (int y = 0; y < height; ++y)
    area(column(y), y) = catchment_km2 + 1e-4F * static_cast<float>(y);
  return area;
}

TEST(Rivers, GrowSteadilyWithTheCatchment) {
  EXPECT_NEAR(river_half_width_m(110.0), 18.0, 1e-9);
  EXPECT_NEAR(river_half_width_m(500.0), 36.0, 1e-9);
  EXPECT_EQ(river_half_width_m(75.0), 0.0);
  EXPECT_EQ(river_half_width_m(1e7), 90.0);
  double before = 0.0;
  for (double area = 60.0; area < 5000.0; area += 1.0) {
    const double here = river_half_width_m(area);
    EXPECT_GE(here, before);
    EXPECT_LE(here - before, 1.5) << area;  // no jump
    before = here;
  }
}

// Catchments of a river down a line of cells: `row(x)` for every column, growing to the east.
template <class F>
Grid<float> river_along(int width, int height, double from_km2, double to_km2, F&& row) {
  Grid<float> area(width, height, 1.F);
  int y = row(0);
  double step = 0.0;
  for (int x = 0; x < width; ++x) {
    const int next = row(x);
    for (; y != next; y += next > y ? 1 : -1)
      area(x, y) =
          static_cast<float>(from_km2 + (to_km2 - from_km2) * (step += 0.5) / (2.0 * width));
    area(x, y) = static_cast<float>(from_km2 + (to_km2 - from_km2) * (step += 0.5) / (2.0 * width));
  }
  return area;
}

TEST(Rivers, AreAsWideAsTheirCatchmentSays) {
  // A straight river of 500 km²: 72 m wide, on cells of 10 m.
  const Grid<float> mask =
      river_mask(river_along(60, 41, 500.0, 500.1, [](int) { return 20; }), 10.0);
  for (int x = 20; x < 40; ++x) {
    double width_m = 0.0;
    for (int y = 0; y < 41; ++y) width_m += 10.0 * mask(x, y);
    EXPECT_NEAR(width_m, 72.0, 0.5) << x;
    EXPECT_FLOAT_EQ(mask(x, 20), 1.F);
    EXPECT_FLOAT_EQ(mask(x, 30), 0.F);
  }
}

TEST(Rivers, ThinOnesCoverAPartOfTheirCells) {
  // 36 m of water, drawn 60 m wide to be visible, in cells of 200 m: three tenths, not nothing and
  // not a whole cell.
  const Grid<float> mask =
      river_mask(river_along(30, 9, 110.0, 110.1, [](int) { return 4; }), 200.0);
  EXPECT_NEAR(mask(15, 4), 0.3F, 0.01F);
  EXPECT_EQ(mask(15, 6), 0.F);
}

TEST(Rivers, HaveNoStairs) {
  // A line that falls one cell in five. The smoothed one must follow it without the steps.
  const auto line = [](double x) { return 10.0 + 0.2 * x; };
  const Grid<float> mask =
      river_mask(river_along(150, 50, 500.0, 501.0,
                             [&](int x) { return static_cast<int>(std::lround(line(x))); }),
                 30.0);
  double worst = 0.0;
  for (int x = 30; x < 120; ++x) {
    double sum = 0.0;
    double moment = 0.0;
    for (int y = 0; y < 50; ++y) {
      sum += mask(x, y);
      moment += y * static_cast<double>(mask(x, y));
    }
    worst = std::max(worst, std::abs(moment / sum - line(x)));
  }
  EXPECT_LT(worst, 0.15);  // the cells themselves are off by up to 0.5
}

TEST(Rivers, TributariesReachTheMainRiver) {
  // A T: a river of 600 km² along row 40, one of 200 km² down column 50 into it.
  Grid<float> area = river_along(100, 60, 600.0, 600.1, [](int) { return 40; });
  for (int x = 50; x < 100; ++x) area(x, 40) += 200.F;
  for (int y = 0; y < 40; ++y) area(50, y) = 200.F + 0.01F * static_cast<float>(y);
  const Grid<float> mask = river_mask(area, 30.0);
  for (int y = 5; y < 40; ++y)
    EXPECT_GT(*std::max_element(mask.row(y) + 45, mask.row(y) + 56), 0.5F) << y;
}

TEST(Rivers, SmallStreamsAreNone) {
  const Grid<float> mask =
      river_mask(river_along(50, 20, 20.0, 70.0, [](int) { return 10; }), 30.0);
  EXPECT_EQ(*std::max_element(mask.begin(), mask.end()), 0.F);
}

TEST(Rivers, AreTheShareOfEachCellThatTheyCover) {
  const Grid<float> coarse = river_mask(river_down(21, 30, [](int) { return 10; }), 100.0);
  EXPECT_NEAR(coarse(10, 15), 0.6, 1e-3) << "36 m, drawn 60 m wide, of a cell of 100 m";
  EXPECT_EQ(coarse(9, 15), 0.F);
  const Grid<float> fine = river_mask(river_down(21, 30, [](int) { return 10; }), 25.0);
  // From the centreline 12.5 m, 37.5 m and 62.5 m: cells end there, the river at 18 m.
  EXPECT_NEAR(fine(10, 15), 1.0, 1e-3);
  EXPECT_NEAR(fine(11, 15), 0.22, 1e-3);
  EXPECT_NEAR(fine(9, 15), 0.22, 1e-3);
  EXPECT_EQ(fine(12, 15), 0.F);
}

// A grid's path to the south-south-east goes in steps of one and two; smoothed it is the straight
// line x = y / 2 - 1/4.
TEST(Rivers, ASmoothedPathIsAStraightLine) {
  constexpr double cell_m = 50.0;
  const Grid<float> mask = river_mask(river_down(60, 100, [](int y) { return y / 2; }), cell_m);
  for (const auto [x, y] : test::cells({0, 40, 60, 60})) {
    const double distance_m = std::abs(x - (0.5 * y - 0.25)) / std::sqrt(1.25) * cell_m;
    const double covered =
        std::min(distance_m + 0.5 * cell_m, 29.0) - std::max(distance_m - 0.5 * cell_m, -29.0);
    EXPECT_NEAR(mask(x, y), std::clamp(covered / cell_m, 0.0, 1.0), 2e-3) << x << ' ' << y;
  }
}

TEST(Rivers, ATributaryDoesNotMoveItsRiver) {
  Grid<float> area = river_down(
      41, 40, [](int) { return 20; }, 300.F);
  const Grid<float> alone = river_mask(area, 50.0);
  for (int x = 0; x < 20; ++x) area(x, 20) = 110.F + 1e-4F * static_cast<float>(x);
  const Grid<float> both = river_mask(area, 50.0);
  for (const auto [x, y] : test::cells({21, 0, 41, 40}))
    ASSERT_EQ(both(x, y), alone(x, y)) << x << ' ' << y;
}

}  // namespace
}  // namespace belvedere
