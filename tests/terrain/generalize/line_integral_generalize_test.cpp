#include "terrain/generalize/line_integral_generalize.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/filter.h"
#include "base/parallel.h"
#include "terrain/synthetic/synthetic_plan.h"
#include "tests/grids.h"
#include "tests/terrain/generalize/synthetic_relief.h"

namespace belvedere {
namespace {

using test::cell_m;
using test::grid_of;

Grid<float> run_along_lines(const Grid<float>& altitude_m,
                            const LineIntegralParameters& parameters = {}) {
  return generalize_along_slope_lines(altitude_m, {}, cell_m, parameters, silent_progress());
}

double largest_difference(const Grid<float>& a, const Grid<float>& b, int margin) {
  double largest = 0.0;
  for (const auto [x, y] : test::cells({margin, margin, a.width() - margin, a.height() - margin}))
    largest = std::max(largest, std::abs(static_cast<double>(a(x, y)) - b(x, y)));
  return largest;
}

// A roof with a horizontal crest in column 80, 30° steep, and gullies and noise on its sides.
double roof(int x, int y) {
  const double side = std::abs(x - 80.0);
  const double detail =
      std::min(side / 10.0, 1.0) * 25.0 * synthetic::fractal_noise(4, x / 6.0, y / 6.0, 3);
  return 2500.0 - side * cell_m * std::tan(0.5235988) + detail;
}

// Mean size of the second difference along columns: detail on the sides.
double roughness(const Grid<float>& z, int x0, int x1) {
  double sum = 0.0;
  for (const auto [x, y] : test::cells({x0, 10, x1, z.height() - 10}))
    sum += std::abs(z(x, y - 1) - 2.0 * z(x, y) + z(x, y + 1));
  return sum;
}

// Height of the crest above its sides, two cells away.
double crest_bend(const Grid<float>& z) {
  double sum = 0.0;
  for (int y = 10; y < z.height() - 10; ++y) sum += 2.0 * z(80, y) - z(78, y) - z(82, y);
  return sum;
}

TEST(LineIntegral, PlanesComeBack) {
  const Grid<float> plane =
      grid_of(70, 50, [](int x, int y) { return 900.0 + 11.0 * x - 7.0 * y; });
  LineIntegralParameters parameters;
  parameters.detail_cells = 0.F;  // the blur replicates borders, slope lines do not
  const Grid<float> out = run_along_lines(plane, parameters);
  // A line that runs along the border and leaves it at a corner has no slope beyond: only the
  // corners may differ slightly.
  EXPECT_LT(largest_difference(out, plane, 1), 0.05);
  EXPECT_LT(largest_difference(run_along_lines(plane), plane, 24), 0.05);
}

TEST(LineIntegral, SidesBecomePlainAndTheCrestStaysSharperThanUnderABlur) {
  const Grid<float> terrain = grid_of(161, 120, roof);
  const Grid<float> out = run_along_lines(terrain);
  EXPECT_LT(roughness(out, 20, 70), 0.1 * roughness(terrain, 20, 70));
  // A Gaussian that leaves as much roughness on the sides is the baseline to beat.
  double sigma = 0.5;
  while (roughness(gaussian_blur(terrain, sigma), 20, 70) > roughness(out, 20, 70)) sigma += 0.25;
  EXPECT_GT(crest_bend(out), 1.5 * crest_bend(gaussian_blur(terrain, sigma)));
}

TEST(LineIntegral, SharpnessOfRidgesIsAParameter) {
  const Grid<float> terrain = grid_of(161, 60, roof);
  LineIntegralParameters blunt;
  blunt.ridge_sharpness = 0.F;
  LineIntegralParameters sharp;
  sharp.ridge_sharpness = 1.F;
  EXPECT_GT(crest_bend(run_along_lines(terrain, sharp)),
            crest_bend(run_along_lines(terrain, blunt)));
}

TEST(LineIntegral, ALakeStaysLevelUpToTheFootOfItsSlopes) {
  const Grid<float> terrain = grid_of(
      120, 80, [](int x, int y) { return x < 60 ? 500.0 : 500.0 + 20.0 * (x - 60) + 0.1 * y; });
  const Grid<float> out = run_along_lines(terrain);
  float highest = 0.F;
  float near_shore = 0.F;
  for (int y = 0; y < 80; ++y) {
    highest = std::max(highest, *std::max_element(out.row(y), out.row(y) + 52));
    near_shore = std::max(near_shore, *std::max_element(out.row(y), out.row(y) + 56));
  }
  EXPECT_LT(highest, 500.01F);
  EXPECT_LT(near_shore, 500.5F);
  // A blur of 5 cells would lift the foot by 20 m · 5 / sqrt(2π) = 40 m.
  EXPECT_LT(out(60, 40), 500.F + 30.F);
}

TEST(LineIntegral, OneOrTwoThreadsAndTinyGrids) {
  const Grid<float> terrain = grid_of(90, 70, roof);
  const auto with = [&](int threads) {
    const ThreadLimit limit(threads);
    return run_along_lines(terrain);
  };
  EXPECT_EQ(with(1), with(2));
  const Grid<float> tiny(1, 5, 7.F);
  EXPECT_EQ(run_along_lines(tiny), tiny);
  EXPECT_NO_THROW(run_along_lines(grid_of(2, 2, roof)));
}

TEST(LineIntegral, SaysWhatIsOutOfRange) {
  LineIntegralParameters parameters;
  parameters.length_cells = 0.F;
  EXPECT_THROW(run_along_lines(Grid<float>(8, 8), parameters), Error);
}

TEST(LineIntegral, TheMaskKeepsTheBitsOfItsZeros) {
  const Grid<float> ground = grid_of(161, 60, roof);
  Grid<float> mask(161, 60, 1.F);
  for (const auto [x, y] : test::cells(60, 60))
    mask(x, y) = x < 40 ? 0.F : static_cast<float>(x - 40) / 20.F;
  const Grid<float> all = run_along_lines(ground);
  const Grid<float> out = generalize_along_slope_lines(ground, mask, cell_m, {}, silent_progress());
  for (const auto [x, y] : test::cells(161, 60))
    ASSERT_NEAR(out(x, y), ground(x, y) + mask(x, y) * (all(x, y) - ground(x, y)),
                x < 40 || x >= 60 ? 0.F : 1e-3F)
        << x << ' ' << y;
  EXPECT_GT(largest_difference(all, ground, 5), 5.0);
}

}  // namespace
}  // namespace belvedere
