#include "base/pyramid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "base/random.h"
#include "tests/base/reconstruct.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

using test::largest_difference;

// 5000 m of relief with detail in every band.
Grid<float> rough_terrain(int width, int height) {
  Grid<float> grid(width, height);
  for (const auto [x, y] : test::cells(width, height)) {
    const double broad =
        1800.0 * std::sin(x / 60.0) * std::cos(y / 45.0) + 400.0 * std::sin(x / 5.0 + y / 7.0);
    grid(x, y) = static_cast<float>(2500.0 + broad + 300.0 * (2.0 * random_uniform(4, x, y) - 1.0));
  }
  return grid;
}

Grid<float> weighted_sum(LaplacianPyramid pyramid, const std::vector<float>& weights) {
  for (std::size_t i = 0; i < pyramid.bands.size(); ++i)
    for (float& v : pyramid.bands[i]) v *= weights[i];
  return test::reconstruct(pyramid);
}

TEST(Pyramid, SizesHalveRoundingUp) {
  const std::vector<Grid<float>> levels = make_gaussian_pyramid(Grid<float>(37, 61, 1.F), 6);
  const std::vector<std::pair<int, int>> sizes = {{37, 61}, {19, 31}, {10, 16},
                                                  {5, 8},   {3, 4},   {2, 2}};
  ASSERT_EQ(levels.size(), sizes.size());
  for (std::size_t i = 0; i < sizes.size(); ++i)
    EXPECT_EQ(std::pair(levels[i].width(), levels[i].height()), sizes[i]);
  EXPECT_EQ(max_bands(37, 61), 5);
  EXPECT_EQ(make_laplacian_pyramid(levels[0], 20).bands.size(), 5U);
  EXPECT_EQ(max_bands(2, 100), 0);
  EXPECT_THROW(expand(Grid<float>(5, 5), 11, 10), Error);
}

TEST(Pyramid, ReconstructsTheInput) {
  for (const auto& [width, height] : {std::pair{512, 512}, std::pair{513, 379}, std::pair{37, 61},
                                      std::pair{2, 9}, std::pair{1, 1}}) {
    const Grid<float> values = rough_terrain(width, height);
    for (const int bands : {1, 5, 30})
      EXPECT_LE(
          largest_difference(test::reconstruct(make_laplacian_pyramid(values, bands)), values),
          1e-3)
          << width << " x " << height;
  }
}

TEST(Pyramid, ConstantHasNoBands) {
  const Grid<float> values(91, 40, 3333.25F);
  const LaplacianPyramid pyramid = make_laplacian_pyramid(values, 5);
  for (const Grid<float>& band : pyramid.bands) {
    for (const float v : band)
      ASSERT_LE(std::abs(v), 3333.25 * 2.5e-7);  // float weights sum to 1 within two roundings
  }
  EXPECT_LE(largest_difference(pyramid.base,
                               Grid<float>(pyramid.base.width(), pyramid.base.height(), 3333.25F)),
            1e-3 * 2);
}

TEST(Pyramid, RampStaysARampWhateverTheWeights) {
  for (const auto& [width, height] :
       {std::pair{64, 64}, std::pair{65, 50}, std::pair{7, 3}, std::pair{130, 2}}) {
    Grid<float> ramp(width, height);
    for (const auto [x, y] : test::cells(width, height))
      ramp(x, y) = 100.F + 12.5F * static_cast<float>(x) - 7.25F * static_cast<float>(y);
    const Grid<float> out =
        weighted_sum(make_laplacian_pyramid(ramp, 5), {0.F, 3.F, 0.5F, 5.F, 2.F});
    EXPECT_LE(largest_difference(out, ramp), 5e-3) << width << " x " << height;
  }
}

TEST(Pyramid, ReduceKeepsARampOnGridsOfTwoCells) {
  for (const auto& [width, height] :
       {std::pair{2, 2}, std::pair{9, 2}, std::pair{2, 9}, std::pair{3, 3}}) {
    Grid<float> ramp(width, height);
    for (const auto [x, y] : test::cells(width, height))
      ramp(x, y) = 10.F + 3.F * static_cast<float>(x) - 5.F * static_cast<float>(y);
    const Grid<float> half = reduce(ramp);
    for (const auto [x, y] : test::cells(half))
      EXPECT_NEAR(half(x, y), ramp(2 * x, 2 * y), 1e-4) << width << " x " << height;
  }
}

TEST(Pyramid, IsLinear) {
  const Grid<float> a = rough_terrain(75, 90);
  Grid<float> b(75, 90);
  Grid<float> mix(75, 90);
  for (std::size_t i = 0; i < a.size(); ++i) {
    b[i] = static_cast<float>(std::cos(0.01 * static_cast<double>(i)) * 900.0);
    mix[i] = 0.5F * a[i] - 2.F * b[i];
  }
  const std::vector<float> weights = {0.F, 1.5F, 1.F, 0.25F};
  const Grid<float> fa = weighted_sum(make_laplacian_pyramid(a, 4), weights);
  const Grid<float> fb = weighted_sum(make_laplacian_pyramid(b, 4), weights);
  Grid<float> expected(75, 90);
  for (std::size_t i = 0; i < a.size(); ++i) expected[i] = 0.5F * fa[i] - 2.F * fb[i];
  EXPECT_LE(largest_difference(weighted_sum(make_laplacian_pyramid(mix, 4), weights), expected),
            5e-3);
}

// Response of the 5-tap kernel to a wave of angular frequency w, radians per cell: the transform of
// [.05 .25 .4 .25 .05].
double kernel_gain(double w) { return 0.4 + 0.5 * std::cos(w) + 0.1 * std::cos(2.0 * w); }

// Share of cos(w x) in band `level` of a wave along x, measured far from the borders over whole
// periods.
double band_gain(int level, int periods, int cells) {
  const double w = 2.0 * std::numbers::pi * periods / cells;
  Grid<float> wave(4 * cells, 40);
  for (const auto [x, y] : test::cells(wave)) wave(x, y) = static_cast<float>(std::cos(w * x));
  const LaplacianPyramid pyramid = make_laplacian_pyramid(wave, level + 1);
  const Grid<float>& band = pyramid.bands[static_cast<std::size_t>(level)];
  const int step = 1 << level;
  double sum = 0.0;
  int count = 0;
  for (int x = cells; x < 2 * cells; x += step, ++count)
    sum += band(x / step, band.height() / 2) * std::cos(w * x);
  return 2.0 * sum / count;
}

TEST(Pyramid, GainOfAWaveInTheFinestBand) {
  const int cells = 128;
  for (const int periods :
       {1, 4, 10, 17, 25, 31, 40, 50, 60}) {  // not 32: there the wave and its image coincide
    const double h = kernel_gain(2.0 * std::numbers::pi * periods / cells);
    EXPECT_NEAR(band_gain(0, periods, cells), 1.0 - h * h, 1e-5) << periods;
  }
}

TEST(Pyramid, GainOfAWaveInCoarserBands) {
  // A wave that level 1 or 2 can represent: each reduction multiplies by H at its own frequency,
  // then the band by 1 - H².
  const int cells = 128;
  for (const int periods : {1, 3, 7, 11}) {
    const double w = 2.0 * std::numbers::pi * periods / cells;
    const double h2 = kernel_gain(2.0 * w);
    const double h4 = kernel_gain(4.0 * w);
    EXPECT_NEAR(band_gain(1, periods, cells), kernel_gain(w) * (1.0 - h2 * h2), 1e-5) << periods;
    EXPECT_NEAR(band_gain(2, periods, cells), kernel_gain(w) * h2 * (1.0 - h4 * h4), 1e-5)
        << periods;
  }
}

TEST(Pyramid, ReduceEqualsTheDefinition) {
  const Grid<float> values = rough_terrain(24, 19);
  const Grid<float> half = reduce(values);
  const double kernel[5] = {0.05, 0.25, 0.4, 0.25, 0.05};
  // Linear extension, as the header defines it.
  const auto at = [&](int x, int y) {
    const auto along = [](int i, int n, auto&& f) {
      if (i < 0) return 2.0 * f(0) - f(-i);
      if (i >= n) return 2.0 * f(n - 1) - f(2 * (n - 1) - i);
      return f(i);
    };
    return along(y, values.height(), [&](int v) {
      return along(x, values.width(), [&](int u) { return static_cast<double>(values(u, v)); });
    });
  };
  for (const auto [x, y] : test::cells(half)) {
    double sum = 0.0;
    for (int j = -2; j <= 2; ++j)
      for (int i = -2; i <= 2; ++i) sum += kernel[i + 2] * kernel[j + 2] * at(2 * x + i, 2 * y + j);
    ASSERT_NEAR(half(x, y), sum, 2e-3) << x << ' ' << y;
  }
}

TEST(Pyramid, SameBitsForAnyThreadCount) {
  const Grid<float> values = rough_terrain(301, 220);
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return weighted_sum(make_laplacian_pyramid(values, 5), {0.3F, 1.F, 2.F, 0.F, 1.1F});
  };
  EXPECT_EQ(run(1), run(2));
}

// x² / 2: the kernel adds half its mean square, 0.9 cells² by reducing and 0.8 or 1 by expanding.
TEST(Pyramid, AnEvenExpansionOfCurvedGroundDoesNotAlternate) {
  const Grid<float> bowl = test::grid_of(64, 9, [&](int x, int) { return 0.5 * x * x; });
  const Grid<float> coarser = reduce(bowl);
  std::vector<float> even(64);
  std::vector<float> usual(64);
  expand_evenly_row(coarser, 4, 64, even.data());
  expand_row(coarser, 4, 64, usual.data());
  for (std::size_t x = 8; x < 56; ++x) {
    EXPECT_NEAR(even[x] - bowl(static_cast<int>(x), 4), 0.95, 1e-3) << x;
    EXPECT_NEAR(usual[x] - bowl(static_cast<int>(x), 4), x % 2 == 0 ? 0.85 : 0.95, 1e-3) << x;
  }
}

}  // namespace
}  // namespace belvedere
