#include "base/noise.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>
#include <vector>

#include "base/random.h"

namespace belvedere {
namespace {

// Mean of f(seed) over many seeds.
template <class F>
double mean_over_seeds(F&& f, int count = 4000) {
  double sum = 0.0;
  for (int seed = 0; seed < count; ++seed) sum += f(static_cast<std::uint64_t>(seed));
  return sum / count;
}

TEST(GaussianNoise, HasMeanNoughtAndDeviationOneAtEachPlace) {
  // On a lattice point, between them, far from the origin, at negative positions: a spline of white
  // noise is stationary only because each position is normalized by its own weights.
  const double spacing = 30.0 * std::sqrt(3.0);
  for (const std::pair<double, double>& position :
       std::vector<std::pair<double, double>>{{0.0, 0.0},
                                              {spacing / 2, spacing / 2},
                                              {spacing, 0.3 * spacing},
                                              {-1234.5, 77.0},
                                              {690000.0, 5.25e6}}) {
    const double x = position.first;
    const double y = position.second;
    const double mean =
        mean_over_seeds([&](std::uint64_t s) { return gaussian_noise(s, x, y, 30.0); });
    const double variance = mean_over_seeds(
        [&](std::uint64_t s) { return std::pow(gaussian_noise(s, x, y, 30.0), 2); });
    EXPECT_NEAR(mean, 0.0, 4.0 / std::sqrt(4000.0)) << x << ' ' << y;
    EXPECT_NEAR(variance, 1.0, 4.0 * std::sqrt(2.0 / 4000.0)) << x << ' ' << y;
  }
}

TEST(GaussianNoise, IsCorrelatedOverAboutSigma) {
  // White noise under a Gaussian of deviation s has the correlation exp(-d² / 4 s²).
  const double sigma = 50.0;
  for (const double distance : {0.5, 1.0, 1.5, 2.0, 3.0}) {
    for (const double angle : {0.0, 0.8, 1.57}) {
      const double dx = distance * sigma * std::cos(angle);
      const double dy = distance * sigma * std::sin(angle);
      double correlation = 0.0;
      for (const double phase : {0.0, 21.0, 43.0}) {  // mean over the lattice
        correlation += mean_over_seeds([&](std::uint64_t s) {
                         return gaussian_noise(s, phase, 2.0 * phase, sigma) *
                                gaussian_noise(s, phase + dx, 2.0 * phase + dy, sigma);
                       }) /
                       3.0;
      }
      EXPECT_NEAR(correlation, std::exp(-distance * distance / 4.0), 0.08)
          << distance << ' ' << angle;
    }
  }
}

TEST(GaussianNoise, HasItsOwnWidthAlongEachAxis) {
  const auto correlation = [](double dx, double dy) {
    return mean_over_seeds([&](std::uint64_t s) {
      return gaussian_noise(s, 3.0, 4.0, 100.0, 10.0) *
             gaussian_noise(s, 3.0 + dx, 4.0 + dy, 100.0, 10.0);
    });
  };
  EXPECT_GT(correlation(30.0, 0.0), 0.9);
  EXPECT_LT(correlation(0.0, 30.0), 0.2);
  EXPECT_EQ(gaussian_noise(5, 1.0, 2.0, 7.0), gaussian_noise(5, 1.0, 2.0, 7.0, 7.0));
}

TEST(GaussianNoise, IsSmooth) {
  // Value and slope are continuous, also across lattice lines (multiples of the spacing).
  const double sigma = 20.0;
  const double spacing = sigma * std::sqrt(3.0);
  const double h = 1e-4;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const auto at = [&](double x) { return gaussian_noise(seed, x, 13.0, sigma); };
    for (const double x : {spacing, -2.0 * spacing, 0.4 * spacing}) {
      const double left = (at(x) - at(x - h)) / h;
      const double right = (at(x + h) - at(x)) / h;
      EXPECT_NEAR(left, right, 1e-4) << seed << ' ' << x;
      EXPECT_LT(std::abs(right), 10.0 / sigma);
    }
  }
}

// Threads cache the lattice under recent positions: the value must always equal the definition.
TEST(GaussianNoise, HangsOnNothingThatWasAskedBefore) {
  const auto defined = [](std::uint64_t seed, double x, double y, double sigma) {
    const auto weights = [](double position) {
      const double t = position - std::floor(position);
      const double u = 1.0 - t;
      return std::array<double, 4>{u * u * u / 6.0, (4.0 - 6.0 * t * t + 3.0 * t * t * t) / 6.0,
                                   (4.0 - 6.0 * u * u + 3.0 * u * u * u) / 6.0, t * t * t / 6.0};
    };
    const double px = x / (sigma * 1.7320508075688772);
    const double py = y / (sigma * 1.7320508075688772);
    const std::array<double, 4> wx = weights(px);
    const std::array<double, 4> wy = weights(py);
    double sum = 0.0;
    double squares_x = 0.0;
    double squares_y = 0.0;
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i)
        sum +=
            wy[j] * wx[i] *
            random_normal(
                seed, static_cast<std::int64_t>(std::floor(px)) - 1 + static_cast<std::int64_t>(i),
                static_cast<std::int64_t>(std::floor(py)) - 1 + static_cast<std::int64_t>(j));
      squares_x += wx[j] * wx[j];
      squares_y += wy[j] * wy[j];
    }
    return sum / std::sqrt(squares_x * squares_y);
  };
  // Keys that differ in only one word, one after the other, and many more than are cached.
  for (int round = 0; round < 2; ++round)
    for (std::int64_t k = -300; k < 300; ++k)
      for (const auto& [seed, x, y] :
           {std::tuple{3, k, std::int64_t{0}}, std::tuple{3, std::int64_t{0}, k},
            std::tuple{static_cast<int>(k), k, k}, std::tuple{4, k, std::int64_t{0}}}) {
        const auto at = [&](std::int64_t position) {
          return 2.0 * static_cast<double>(position) + 0.3;
        };
        ASSERT_NEAR(gaussian_noise(static_cast<std::uint64_t>(seed), at(x), at(y), 1.0),
                    defined(static_cast<std::uint64_t>(seed), at(x), at(y), 1.0), 1e-12)
            << seed << ' ' << x << ' ' << y;
      }
}

TEST(GaussianNoise, SeedsAreIndependent) {
  double product = 0.0;
  int count = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x, ++count)
      product +=
          gaussian_noise(1, 9.0 * x, 9.0 * y, 2.0) * gaussian_noise(2, 9.0 * x, 9.0 * y, 2.0);
  }
  EXPECT_NEAR(product / count, 0.0, 4.0 / 60.0);
}

}  // namespace
}  // namespace belvedere
