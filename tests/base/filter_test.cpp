#include "base/filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

using test::largest_difference;

Grid<float> noise_grid(int width, int height, std::uint64_t seed) {
  return test::grid_of(width, height, [&](int x, int y) { return random_uniform(seed, x, y); });
}

// The definition of gaussian_blur, in double, without optimizations.
Grid<float> reference_blur(const Grid<float>& values, double sigma_x, double sigma_y) {
  const auto kernel = [](double sigma) {
    std::vector<double> weights;
    const int radius = static_cast<int>(std::ceil(4.0 * sigma));
    double sum = 0.0;
    for (int i = -radius; i <= radius; ++i)
      weights.push_back(std::exp(-0.5 * i * i / (sigma * sigma)));
    for (const double w : weights) sum += w;
    for (double& w : weights) w /= sum;
    return weights;
  };
  const std::vector<double> kx = kernel(sigma_x);
  const std::vector<double> ky = kernel(sigma_y);
  const int rx = static_cast<int>(kx.size() / 2);
  const int ry = static_cast<int>(ky.size() / 2);
  Grid<double> rows(values.width(), values.height());
  Grid<float> out(values.width(), values.height());
  for (const auto [x, y] : test::cells(values))
    for (int k = -rx; k <= rx; ++k)
      rows(x, y) += kx[static_cast<std::size_t>(k + rx)] * values.clamped(x + k, y);
  for (const auto [x, y] : test::cells(values)) {
    double sum = 0.0;
    for (int k = -ry; k <= ry; ++k)
      sum += ky[static_cast<std::size_t>(k + ry)] * rows.clamped(x, y + k);
    out(x, y) = static_cast<float>(sum);
  }
  return out;
}

class BlurAgainstDefinition : public testing::TestWithParam<double> {};

TEST_P(BlurAgainstDefinition, OnWhiteNoiseAndStep) {
  const double sigma = GetParam();
  for (const auto& [width, height] : {std::pair{97, 120}, std::pair{64, 33}, std::pair{3, 151}}) {
    Grid<float> values = noise_grid(width, height, 3);
    // A step as high as the noise, the worst possible edge.
    for (const auto [x, y] : test::cells({width / 2, 0, width, height})) values(x, y) += 1.0F;
    const double error = largest_difference(gaussian_blur(values, sigma, 0.7 * sigma),
                                            reference_blur(values, sigma, 0.7 * sigma));
    // Both axes may halve the resolution; the header promises 3e-4 of the range, which is 2 here.
    EXPECT_LT(error, sigma <= 8.0 ? 2e-6 : 2.0 * 3e-4) << width << " x " << height;
  }
}

INSTANTIATE_TEST_SUITE_P(Sigmas, BlurAgainstDefinition,
                         testing::Values(0.4, 1.0, 2.5, 7.9, 8.1, 11.3, 16.1, 20.0, 37.0, 60.0));

TEST(GaussianBlur, KeepsAConstantAndTheMeanOfAnImpulse) {
  const Grid<float> constant(70, 50, 4321.5F);
  for (const double sigma : {1.0, 6.0, 40.0}) {
    EXPECT_LT(largest_difference(gaussian_blur(constant, sigma), constant), 4321.5 * 1e-6) << sigma;
    Grid<float> impulse(401, 401, 0.0F);
    impulse(200, 200) = 1.0F;
    const Grid<float> blurred = gaussian_blur(impulse, sigma);
    double sum = 0.0;
    double variance = 0.0;
    for (const auto [x, y] : test::cells(401, 401)) {
      sum += blurred(x, y);
      variance += blurred(x, y) * (x - 200.0) * (x - 200.0);
    }
    EXPECT_NEAR(sum, 1.0, 2e-4) << sigma;
    EXPECT_NEAR(std::sqrt(variance / sum), sigma, 0.005 * sigma) << sigma;
  }
}

TEST(GaussianBlur, AxesAreIndependentAndZeroSigmaCopies) {
  const Grid<float> values = noise_grid(40, 30, 5);
  EXPECT_EQ(gaussian_blur(values, 0.0), values);
  EXPECT_EQ(gaussian_blur(values, -1.0, 0.0), values);
  EXPECT_LT(largest_difference(gaussian_blur(gaussian_blur(values, 3.0, 0.0), 0.0, 12.0),
                               gaussian_blur(values, 3.0, 12.0)),
            1e-7);
  EXPECT_TRUE(gaussian_blur(Grid<float>{}, 2.0).empty());
  EXPECT_EQ(gaussian_blur(Grid<float>(1, 1, 7.0F), 20.0)(0, 0), 7.0F);
}

TEST(Filters, SameBitsForAnyThreadCount) {
  const Grid<float> values = noise_grid(333, 217, 9);
  Grid<std::uint8_t> mask(333, 217);
  for (std::size_t i = 0; i < mask.size(); ++i) mask[i] = values[i] > 0.99F;
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return std::tuple{gaussian_blur(values, 5.0, 21.0), window_minimum(values, 13),
                      nearest_marked(mask)};
  };
  EXPECT_EQ(run(1), run(2));
}

TEST(WindowExtremes, EqualBruteForce) {
  for (const auto& [width, height] : {std::pair{50, 41}, std::pair{17, 3}, std::pair{1, 20}}) {
    const Grid<float> values = noise_grid(width, height, 21);
    for (const int radius : {0, 1, 2, 5, 16, 300}) {
      const Grid<float> low = window_minimum(values, radius);
      const Grid<float> high = window_maximum(values, radius);
      const int reach = std::min(radius, 60);
      for (const auto [x, y] : test::cells(width, height)) {
        float smallest = values(x, y);
        float largest = values(x, y);
        for (int v = y - reach; v <= y + reach; ++v)
          for (int u = x - reach; u <= x + reach; ++u) {
            smallest = std::min(smallest, values.clamped(u, v));
            largest = std::max(largest, values.clamped(u, v));
          }
        ASSERT_EQ(low(x, y), smallest) << x << ' ' << y << " radius " << radius;
        ASSERT_EQ(high(x, y), largest) << x << ' ' << y << " radius " << radius;
      }
    }
  }
}

TEST(NearestMarked, EqualsBruteForceTiesIncluded) {
  for (const auto& [width, height] : {std::pair{31, 23}, std::pair{40, 9}, std::pair{7, 40}})
    for (const double share : {0.002, 0.02, 0.2, 0.7})
      for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Grid<std::uint8_t> mask(width, height);
        for (const auto [x, y] : test::cells(width, height))
          mask(x, y) = random_uniform(seed, x, y, 7) < share ? 255 : 0;
        const Grid<std::int32_t> nearest = nearest_marked(mask);
        for (const auto [x, y] : test::cells(width, height)) {
          int best = -1;
          int best_distance = 0;
          for (int i = 0; i < width * height; ++i) {
            if (mask[static_cast<std::size_t>(i)] == 0) continue;
            const int dx = i % width - x;
            const int dy = i / width - y;
            if (best < 0 || dx * dx + dy * dy < best_distance) {
              best = i;
              best_distance = dx * dx + dy * dy;
            }
          }
          ASSERT_EQ(nearest(x, y), best) << x << ' ' << y << " seed " << seed << " share " << share;
        }
      }
}

TEST(NearestMarked, EmptyMaskGivesMinusOne) {
  const Grid<std::int32_t> nearest = nearest_marked(Grid<std::uint8_t>(5, 4));
  EXPECT_TRUE(std::all_of(nearest.begin(), nearest.end(), [](std::int32_t i) { return i == -1; }));
  EXPECT_TRUE(nearest_marked(Grid<std::uint8_t>{}).empty());
}

TEST(Sampling, BilinearIsExactOnBilinearFunctionsAndReplicatesBorders) {
  Grid<float> values(9, 7);
  const auto f = [](double x, double y) { return 3.0 + 2.0 * x - y + 0.25 * x * y; };
  for (const auto [x, y] : test::cells(9, 7)) values(x, y) = static_cast<float>(f(x, y));
  EXPECT_FLOAT_EQ(sample_bilinear(values, 3.0, 2.0), values(3, 2));
  EXPECT_NEAR(sample_bilinear(values, 3.7, 4.2), f(3.7, 4.2), 1e-5);
  EXPECT_FLOAT_EQ(sample_bilinear(values, -1e12, 1e12), values(0, 6));
  Grid<glm::vec2> pairs(values.width(), values.height());
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = {values[i], -2.F * values[i]};
  EXPECT_NEAR(sample_bilinear(pairs, 3.7, 4.2).x, f(3.7, 4.2), 1e-5);
  EXPECT_NEAR(sample_bilinear(pairs, 3.7, 4.2).y, -2.0 * f(3.7, 4.2), 1e-5);
  EXPECT_NEAR(sample_bilinear(values, 8.4, 2.5), f(8.0, 2.5), 1e-5);
}

TEST(Sampling, BsplineReproducesLinesAndSmoothsParabolas) {
  Grid<float> line(20, 20);
  Grid<float> parabola(20, 20);
  for (const auto [x, y] : test::cells(20, 20)) {
    line(x, y) = static_cast<float>(5.0 - 1.5 * x + 0.5 * y);
    parabola(x, y) = static_cast<float>(x * x);
  }
  EXPECT_NEAR(sample_bspline(line, 7.3, 11.8), 5.0 - 1.5 * 7.3 + 0.5 * 11.8, 1e-5);
  // A cubic B-spline has the variance 1/3, so x² becomes x² + 1/3 everywhere.
  for (const double x : {5.0, 5.25, 5.5, 5.9})
    EXPECT_NEAR(sample_bspline(parabola, x, 9.4), x * x + 1.0 / 3.0, 1e-4) << x;
  EXPECT_FLOAT_EQ(sample_bspline(line, -50.0, -50.0), line(0, 0));
}

TEST(Sampling, BsplineHasAContinuousSlope) {
  const Grid<float> values = noise_grid(20, 20, 2);
  const double h = 1e-2;
  for (const double x : {4.0, 9.0, 12.0}) {
    const double left = (sample_bspline(values, x, 8.3) - sample_bspline(values, x - h, 8.3)) / h;
    const double right = (sample_bspline(values, x + h, 8.3) - sample_bspline(values, x, 8.3)) / h;
    EXPECT_NEAR(left, right, 0.05);
  }
}

}  // namespace
}  // namespace belvedere
