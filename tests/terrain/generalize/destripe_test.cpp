#include "terrain/generalize/destripe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "base/error.h"
#include "base/filter.h"
#include "base/parallel.h"
#include "base/random.h"
#include "terrain/io/raster_io.h"
#include "terrain/synthetic/synthetic_plan.h"
#include "tests/grids.h"
#include "tests/paths.h"

namespace belvedere {
namespace {

using test::grid_of;

// Ranges of all directions with detail, and a crest that runs dead straight along row 150 for half
// the width.
double ridged(double x, double y, int octaves = 6) {
  const double ranges = 900.0 * synthetic::ridged_noise(3, x / 130.0, y / 130.0, octaves);
  const double straight = x < 200.0 ? 220.0 * std::max(0.0, 1.0 - std::abs(y - 150.0) / 14.0) : 0.0;
  return 1200.0 + ranges + straight;
}

double rms_difference(const Grid<float>& a, const Grid<float>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(static_cast<double>(a[i]) - b[i], 2);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

// RMS of what b adds to a that is constant along whole rows, away from the crest.
double row_stripes(const Grid<float>& a, const Grid<float>& b) {
  double sum = 0.0;
  for (int y = 0; y < a.height(); ++y) {
    if (std::abs(y - 150) < 16) continue;
    double row = 0.0;
    for (int x = 0; x < a.width(); ++x) row += b(x, y) - a(x, y);
    sum += std::pow(row / a.width(), 2);
  }
  return std::sqrt(sum / a.height());
}

// Bands of three or four rows, all different, 3 m on average (RMS).
double band(int y) {
  return 4.5 * std::sin(y * 1.7 + 2.0 * random_uniform(5, y / 40, 0)) *
         (0.7 + 0.6 * random_uniform(6, y / 9, 0));
}

const Grid<float>& clean() {
  static const Grid<float> grid = grid_of(400, 360, [](int x, int y) { return ridged(x, y); });
  return grid;
}

TEST(Destripe, TerrainWithoutStripesComesBackBitForBit) {
  EXPECT_EQ(destripe(clean(), {}, silent_progress()), clean());
}

TEST(Destripe, TakesOffRowsThatStandTooHighOrLowAndKeepsRidges) {
  const Grid<float> striped =
      grid_of(400, 360, [](int x, int y) { return ridged(x, y) + band(y); });
  const Grid<float> out = destripe(striped, {}, silent_progress());
  EXPECT_LT(row_stripes(clean(), out), 0.15 * row_stripes(clean(), striped));
  // Little else changes: the part that is not constant along rows.
  EXPECT_LT(rms_difference(clean(), out), 0.22 * row_stripes(clean(), striped));
  // A crest along the rows is itself like a stripe; it must stay as sharp as before.
  const auto bend = [](const Grid<float>& z) {
    double sum = 0.0;
    for (int x = 20; x < 180; ++x) sum += z(x, 148) - 2.0 * z(x, 150) + z(x, 152);
    return sum;
  };
  EXPECT_NEAR(bend(out) / bend(striped), 1.0, 0.15);
}

TEST(Destripe, StripesThatChangeOnTheirWayAndLakesThatHaveNone) {
  Grid<float> terrain(clean());
  const auto in_lake = [](int x, int y) { return std::hypot(x - 300.0, y - 250.0) < 30.0; };
  Grid<float> striped(terrain.width(), terrain.height());
  for (const auto [x, y] : test::cells(terrain)) {
    if (in_lake(x, y)) terrain(x, y) = 700.F;
    // Each stripe changes into another one from the left border to the right.
    const double share = x / 400.0;
    const double stripe =
        1.4 * (std::cos(1.5708 * share) * band(y) + std::sin(1.5708 * share) * band(y + 1000));
    striped(x, y) = terrain(x, y) + (in_lake(x, y) ? 0.F : static_cast<float>(stripe));
  }
  const Grid<float> out = destripe(striped, {}, silent_progress());
  EXPECT_LT(rms_difference(terrain, out), 0.4 * rms_difference(terrain, striped));
  for (const auto [x, y] : test::cells({285, 225, 315, 275})) EXPECT_EQ(out(x, y), 700.F);
}

TEST(Destripe, RealMountainsKeepNextToNothingOfMadeUpStripes) {
  const std::string path = test::data_folder() + "/big_tujunga/bigtujunga.tif";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  RasterSource source;
  source.path = path;
  const Grid<float> whole = read_raster(source).cells;
  Grid<float> terrain(700, 300);
  for (const auto [x, y] : test::cells(700, 300)) terrain(x, y) = whole(x + 300, y + 120);
  Grid<float> striped = terrain;
  for (const auto [x, y] : test::cells(700, 300)) striped(x, y) += static_cast<float>(band(y));
  const Grid<float> out = destripe(striped, {}, silent_progress());
  EXPECT_LT(rms_difference(terrain, out), 0.15 * rms_difference(terrain, striped));
}

TEST(Destripe, TakesOffColumnsAsWell) {
  const Grid<float> striped =
      grid_of(360, 400, [](int x, int y) { return ridged(y, x) + band(x); });
  const Grid<float> turned = grid_of(360, 400, [](int x, int y) { return ridged(y, x); });
  EXPECT_LT(rms_difference(turned, destripe(striped, {}, silent_progress())),
            0.22 * rms_difference(turned, striped));
}

TEST(Destripe, UndoesTheStepsOfNearestNeighbours) {
  // A grid turned by 9° and resampled by nearest neighbours: each cell shows the terrain of up to
  // half a cell beside it.
  const double turn = 9.0 * 3.14159265358979 / 180.0;
  const Grid<float> stepped = grid_of(400, 360, [&](int x, int y) {
    const double u = std::round(x * std::cos(turn) + y * std::sin(turn));
    const double v = std::round(y * std::cos(turn) - x * std::sin(turn));
    return ridged(u * std::cos(turn) - v * std::sin(turn), v * std::cos(turn) + u * std::sin(turn),
                  4);
  });
  const Grid<float> smooth = grid_of(400, 360, [](int x, int y) { return ridged(x, y, 4); });
  const Grid<float> out = destripe(stepped, {}, silent_progress());
  EXPECT_LT(rms_difference(smooth, out), 0.7 * rms_difference(smooth, stepped));
}

TEST(Destripe, SmallGridsAndOneOrTwoThreads) {
  const Grid<float> small = grid_of(30, 400, [](int x, int y) { return ridged(x, y) + band(y); });
  EXPECT_EQ(destripe(small, {}, silent_progress()), small);
  const Grid<float> striped =
      grid_of(150, 131, [](int x, int y) { return ridged(x, y) + band(y); });
  const auto many = destripe(striped, {}, silent_progress());
  const ThreadLimit one(1);
  EXPECT_EQ(destripe(striped, {}, silent_progress()), many);
}

TEST(Destripe, SaysWhatIsOutOfRange) {
  DestripeParameters parameters;
  parameters.longest_period_cells = 1.F;
  EXPECT_THROW(destripe(clean(), parameters, silent_progress()), Error);
}

TEST(Destripe, RealTerrainLosesItsStripes) {
  const std::string path = test::data_folder() + "/lolo_peak/example_lcp.tif";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
  RasterSource source;
  source.path = path;
  const Grid<float> before = read_raster(source).cells;
  const Grid<float> after = destripe(before, {}, silent_progress());
  // Its stripes are 4.5 rows wide: energy of that band on the slopes, along lines of their tilt
  // (.1), against a tilt of .2 without stripes.
  const auto energy = [](const Grid<float>& z, double tilt) {
    const Grid<float> smooth = gaussian_blur(z, 1.6);
    double sum = 0.0;
    for (int y = 60; y < z.height() - 60; ++y)
      for (int x0 = 0; x0 + 64 <= z.width(); x0 += 64) {
        double line = 0.0;
        for (int x = x0 + 1; x < x0 + 63; ++x) {
          const int v = y + static_cast<int>(std::lround(tilt * (x - x0 - 32)));
          line += (z(x, v) - 0.25 * (z(x, v - 2) + z(x, v + 2) + z(x, v - 3) + z(x, v + 3))) *
                  (smooth(x + 1, v) - smooth(x - 1, v));
        }
        sum += line * line;
      }
    return sum;
  };
  EXPECT_GT(energy(before, -0.1), 2.0 * energy(before, 0.2));
  EXPECT_LT(energy(after, -0.1), 1.3 * energy(after, 0.2));
}

}  // namespace
}  // namespace belvedere
