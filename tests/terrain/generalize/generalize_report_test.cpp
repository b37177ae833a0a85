#include "terrain/generalize/generalize_report.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <tuple>
#include <vector>

#include "base/parallel.h"
#include "base/progress.h"
#include "base/random.h"
#include "terrain/generalize/generalize.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

using test::grid_of;

constexpr glm::dvec2 report_cell_m = {25.0, 25.0};

TEST(DistanceSlices, GoFromNearToFarInEqualSteps) {
  const Grid<float> share = grid_of(6, 1, [](int x, int) {
    return std::array{1.0, 0.76, 0.74, 0.5, 0.1, 0.0}[static_cast<std::size_t>(x)];
  });
  const Grid<std::uint8_t> slices = distance_slices(share, {6, 1}, 4);
  EXPECT_EQ(std::vector<int>(slices.begin(), slices.end()), (std::vector<int>{0, 0, 1, 2, 3, 3}));
  EXPECT_EQ(distance_slices({}, {2, 2}, 3), Grid<std::uint8_t>(2, 2));
}

TEST(BandEnergy, OfStripesOneCellWideIsAllInTheFinestBand) {
  // The 5-tap kernel removes (-1)^x completely: .4 - 2 · .25 + 2 · .05 = 0. Far ground has half the
  // amplitude. Borders are in slices of their own, because they are extended linearly.
  const int width = 160;
  const Grid<float> share = grid_of(width, 32, [&](int x, int) {
    return x < 16 ? 1.0 : x < 80 ? 0.7 : x < 144 ? 0.3 : 0.0;
  });
  const Grid<float> stripes = grid_of(
      width, 32, [](int x, int) { return (x % 2 == 0 ? 1.0 : -1.0) * (x < 80 ? 8.0 : 4.0); });
  const auto energy = band_energy(stripes, share, 3, 4);
  ASSERT_EQ(energy.size(), 4U);
  ASSERT_EQ(energy[1].size(), 3U);
  EXPECT_NEAR(energy[1][2], 64.0, 0.6);
  EXPECT_NEAR(energy[2][2], 16.0, 0.6);
  EXPECT_LT(energy[1][0] + energy[1][1], 0.3);  // coarsest first: nothing there
}

TEST(BandEnergy, IsZeroOnARampAndInBandsTooCoarseForTheTerrain) {
  const auto energy =
      band_energy(grid_of(20, 20, [](int x, int y) { return 3.0 * x + y; }), {}, 8, 2);
  for (const double e : energy[0]) EXPECT_NEAR(e, 0.0, 1e-8);
  for (const double e : energy[1]) EXPECT_EQ(e, 0.0);  // no cells there
}

TEST(AltitudeChange, OfKnownDifferences) {
  const Grid<float> before(4, 2, 1000.F);
  Grid<float> after = before;
  after(0, 0) += 3.F;   // near
  after(1, 0) -= 5.F;   // near
  after(3, 1) -= 12.F;  // far
  const Grid<std::uint8_t> slice_of =
      distance_slices(grid_of(4, 2, [](int x, int) { return x < 2 ? 1.0 : 0.0; }), {4, 2}, 2);
  const auto changes = altitude_change(before, after, slice_of, 2);
  EXPECT_EQ(changes[0].cells, 4U);
  EXPECT_DOUBLE_EQ(changes[0].mean_m, -0.5);
  EXPECT_DOUBLE_EQ(changes[0].rms_m, std::sqrt(34.0 / 4.0));
  EXPECT_DOUBLE_EQ(changes[0].largest_m, 5.0);
  EXPECT_DOUBLE_EQ(changes[1].mean_m, -3.0);
  EXPECT_DOUBLE_EQ(changes[1].rms_m, 6.0);
  EXPECT_DOUBLE_EQ(changes[1].largest_m, 12.0);
}

TEST(CrestCurvature, OfARoundedRidgeInAnyDirection) {
  // z = -k/2 d², d the distance from a line: has curvature k, whatever the line's direction and
  // slope.
  constexpr double k = 0.004;
  for (const double azimuth : {0.0, 0.4, 1.3, 2.2}) {
    const Grid<float> ridge = grid_of(21, 21, [&](int x, int y) {
      const double east = (x - 10) * report_cell_m.x;
      const double north = (10 - y) * report_cell_m.y;
      const double d = east * std::cos(azimuth) + north * std::sin(azimuth);
      return 500.0 - 0.5 * k * d * d + 0.2 * (north * std::cos(azimuth) - east * std::sin(azimuth));
    });
    EXPECT_NEAR(crest_curvature(ridge, report_cell_m)(10, 10), k, 1e-3 * k) << azimuth;
  }
  EXPECT_NEAR(
      crest_curvature(grid_of(9, 9, [](int x, int y) { return 0.5 * k * 625.0 * (x * x + y * y); }),
                      report_cell_m)(4, 4),
      -k, 1e-3 * k);
}

TEST(RidgeLines, RunAlongCrestsOnly) {
  // Ridges at x = 20 and 60 that climb to the south, a valley between them.
  const Grid<float> ridges = grid_of(81, 60, [](int x, int y) {
    return 300.0 * std::cos(2.0 * std::numbers::pi * (x - 20) / 40.0) + 4.0 * y;
  });
  const Grid<std::uint8_t> lines = ridge_lines(ridges, report_cell_m);
  int on = 0;
  for (const auto [x, y] : test::cells({5, 5, 76, 55})) {
    if (lines(x, y) == 0) continue;
    ++on;
    EXPECT_TRUE(x == 20 || x == 60) << x;
  }
  EXPECT_GT(on, 20);
  const Grid<std::uint8_t> none =
      ridge_lines(grid_of(30, 30, [](int x, int y) { return 2.0 * x - y; }), report_cell_m);
  EXPECT_EQ(none, Grid<std::uint8_t>(30, 30));
}

TEST(RidgeSharpness, FindsTheGaussianThatDidIt) {
  // A wave of 24 cells reduced to g of its height: a Gaussian of σ = λ/2π √(-2 ln g) does the same
  // and keeps as much.
  constexpr double wave_cells = 24.0;
  constexpr double g = 0.6;
  const auto wave = [&](double factor) {
    return grid_of(481, 60, [=](int x, int) {
      return factor * 200.0 * std::cos(2.0 * std::numbers::pi * x / wave_cells);
    });
  };
  // The borders, where waves are extended linearly, are in the near slice.
  const Grid<float> share =
      grid_of(481, 60, [](int x, int) { return x < 120 || x > 360 ? 1.0 : 0.0; });
  const RidgeSharpness sharp =
      ridge_sharpness(wave(1.0), wave(g), report_cell_m, share, 5, 2).at(1);
  EXPECT_GT(sharp.cells, 50U);
  EXPECT_NEAR(sharp.kept(), g, 1e-4);
  EXPECT_NEAR(sharp.kept_by_gaussian(), g, 0.01);
  EXPECT_NEAR(sharp.gaussian_cells,
              wave_cells / (2.0 * std::numbers::pi) * std::sqrt(-2.0 * std::log(g)), 0.05);
  // Raised terrain has no equivalent Gaussian.
  const RidgeSharpness higher =
      ridge_sharpness(wave(1.0), wave(1.5), report_cell_m, share, 5, 2).at(1);
  EXPECT_EQ(higher.gaussian_cells, 0.0);
  EXPECT_NEAR(higher.kept(), 1.5, 1e-4);
  EXPECT_EQ(higher.kept_by_gaussian(), 1.0);
}

TEST(RidgeSharpness, CurvatureKeepsMoreThanAGaussianOfEqualEnergy) {
  // Roof ridges with rough slopes.
  const Grid<float> roofs = grid_of(257, 200, [](int x, int y) {
    return 1500.0 - 18.0 * std::abs(x % 64 - 32) + 3.0 * y + 25.0 * (random_uniform(3, x, y) - 0.5);
  });
  const GeneralizeParameters p = {.foreground = {1.F, 0.5F, 0.F, 0.F},
                                  .background = {1.F, 0.5F, 0.F, 0.F},
                                  .foreground_ridges = {0.F, 0.5F, 1.2F, 1.2F},
                                  .background_ridges = {0.F, 0.5F, 1.2F, 1.2F}};
  const Grid<float> out = generalize(roofs, report_cell_m, {}, p, silent_progress());
  const auto sharp = ridge_sharpness(roofs, out, report_cell_m, {}, 4, 1);
  EXPECT_GT(sharp[0].gaussian_cells, 0.3);
  EXPECT_GT(sharp[0].kept(), sharp[0].kept_by_gaussian());
}

TEST(Pits, AreOfTheWholeTerrainAndThoseAtTheFootOfSlopesApart) {
  // A plain before a slope; five cells are dug 4 m deep at its foot, one 9 m deep far away.
  const Grid<float> before =
      grid_of(60, 40, [](int x, int) { return x < 30 ? 500.0 : 500.0 + (x - 29) * 15.0; });
  Grid<float> after = before;
  for (int y = 10; y < 15; ++y) after(27, y) -= 4.F;
  after(3, 3) -= 9.F;
  Grid<std::uint8_t> feet(60, 40);
  for (const auto [x, y] : test::cells({22, 0, 32, 40})) feet(x, y) = 1;
  const Pits pits = find_pits(before, after, feet, report_cell_m);
  EXPECT_NEAR(pits.hollows_m3, (5 * 4.0 + 9.0) * 625.0, 1e-3);
  EXPECT_NEAR(pits.at_feet_m3, 5 * 4.0 * 625.0, 1e-3);
  EXPECT_NEAR(pits.elsewhere_m3(), 9.0 * 625.0, 1e-3);
  EXPECT_NEAR(pits.lowered_m3, 5 * 4.0 * 625.0, 1e-3);
  EXPECT_NEAR(pits.deepest_m, 9.0, 1e-4);
  EXPECT_EQ(pits.count, 2U);
  EXPECT_EQ(pits.elsewhere(), 1U);
  EXPECT_EQ(find_pits(before, before, feet, report_cell_m).hollows_m3, 0.0);
  EXPECT_EQ(find_pits(before, before, feet, report_cell_m).count, 0U);
  // A trench with an outlet holds no water, but ground was removed.
  for (int y = 0; y < 40; ++y) after(27, y) = 496.F;
  const Pits trench = find_pits(before, after, feet, report_cell_m);
  EXPECT_NEAR(trench.at_feet_m3, 0.0, 1e-3);
  EXPECT_EQ(trench.at_feet, 0U);
  EXPECT_NEAR(trench.lowered_m3, 40 * 4.0 * 625.0, 1e-3);
}

TEST(SlopeFeet, LieOnTheFlatBesideTheSlope) {
  const Grid<float> front =
      grid_of(120, 60, [](int x, int) { return x < 60 ? 500.0 : 500.0 + (x - 59) * 20.0; });
  const Grid<std::uint8_t> feet = slope_feet(front, report_cell_m, 4);
  EXPECT_EQ(feet(56, 30), 1);
  EXPECT_EQ(feet(100, 30), 0);  // on the slope
  EXPECT_EQ(feet(2, 30), 0);    // out on the plain
}

TEST(GeneralizeReport, IsTheSameForAnyNumberOfThreads) {
  const Grid<float> z = grid_of(150, 97, [](int x, int y) {
    return 900.0 * random_uniform(5, x / 9, y / 7) + 80.0 * random_uniform(6, x, y);
  });
  const Grid<float> lower = grid_of(150, 97, [&](int x, int y) { return 0.7 * z(x, y); });
  const Grid<float> share = grid_of(150, 97, [](int, int y) { return y / 96.0; });
  const auto measure = [&] {
    const auto sharp = ridge_sharpness(z, lower, report_cell_m, share, 4, 3);
    return std::tuple(band_energy(z, share, 4, 3), sharp[1].gaussian_cells,
                      sharp[2].gaussian_per_m);
  };
  const auto many = measure();
  const ThreadLimit one(1);
  EXPECT_EQ(measure(), many);
}

}  // namespace
}  // namespace belvedere
