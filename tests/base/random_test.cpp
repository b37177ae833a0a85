#include "base/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/grids.h"

namespace belvedere {
namespace {

TEST(Random, IsAFixedFunctionOfItsKey) {
  // Pinned: a change of these numbers changes every picture.
  EXPECT_EQ(random_bits(1, 2, 3, 4), random_bits(1, 2, 3, 4));
  static_assert(random_bits(1, 2, 3, 4) == 0xbc72b7ce8be59402ULL);
  static_assert(random_bits(0, -5, 0) == 0xff425e4cb46769adULL);
}

TEST(Random, EachPartOfTheKeyCounts) {
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 6; ++seed)
    for (std::int64_t x = -6; x < 6; ++x)
      for (std::int64_t y = -6; y < 6; ++y)
        for (std::uint64_t draw = 0; draw < 6; ++draw) seen.insert(random_bits(seed, x, y, draw));
  EXPECT_EQ(seen.size(), 6U * 12 * 12 * 6);
}

TEST(Random, UniformFillsTheUnitIntervalEvenly) {
  std::array<int, 20> bins{};
  double sum = 0.0;
  const int side = 400;
  for (const auto [x, y] : test::cells(side, side)) {
    const double u = random_uniform(7, x, y);
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++bins[static_cast<std::size_t>(u * 20.0)];
    sum += u;
  }
  const double expected = side * side / 20.0;
  double chi2 = 0.0;
  for (const int count : bins) chi2 += (count - expected) * (count - expected) / expected;
  EXPECT_LT(chi2, 43.8);  // 19 degrees of freedom, p = .001
  EXPECT_NEAR(sum / (side * side), 0.5, 4.0 * 0.2887 / side);
}

TEST(Random, NeighboursAreIndependent) {
  // Correlation with the next cell, the next row, the next seed and the next draw: 0 within four
  // standard deviations.
  const int side = 300;
  std::array<double, 4> products{};
  for (const auto [x, y] : test::cells(side, side)) {
    const double here = random_uniform(7, x, y) - 0.5;
    products[0] += here * (random_uniform(7, x + 1, y) - 0.5);
    products[1] += here * (random_uniform(7, x, y + 1) - 0.5);
    products[2] += here * (random_uniform(8, x, y) - 0.5);
    products[3] += here * (random_uniform(7, x, y, 1) - 0.5);
  }
  for (const double p : products) EXPECT_NEAR(12.0 * p / (side * side), 0.0, 4.0 / side);
}

TEST(Random, IndexCoversItsRange) {
  std::array<int, 7> count{};
  for (int x = 0; x < 70000; ++x) {
    const std::uint32_t i = random_index(7, 3, x, 0);
    ASSERT_LT(i, 7U);
    ++count[i];
  }
  for (const int c : count) EXPECT_NEAR(c, 10000, 400);
  EXPECT_EQ(random_index(1, 3, 5, 5), 0U);
}

TEST(Random, NormalHasMeanNoughtAndDeviationOne) {
  double sum = 0.0;
  double squares = 0.0;
  double fourth = 0.0;
  const int side = 400;
  for (const auto [x, y] : test::cells(side, side)) {
    const double n = random_normal(11, x, y);
    ASSERT_LE(std::abs(n), 3.4642);
    sum += n;
    squares += n * n;
    fourth += n * n * n * n;
  }
  const double count = side * side;
  EXPECT_NEAR(sum / count, 0.0, 4.0 / side);
  EXPECT_NEAR(squares / count, 1.0, 0.012);
  EXPECT_NEAR(fourth / count, 2.7, 0.1);  // kurtosis 3 - 1.2 / 4 of four uniforms
}

constexpr auto streams = static_cast<std::uint16_t>(Stream::count);

// Seeds of all streams and some of their parts, of pictures 0…1000.
std::vector<std::uint64_t> all_seeds(std::uint64_t pictures) {
  std::vector<std::uint64_t> seeds;
  for (std::uint64_t picture = 0; picture <= pictures; ++picture)
    for (std::uint16_t stream = 0; stream < streams; ++stream)
      for (std::uint64_t part = 0; part < 3; ++part)
        seeds.push_back(stream_seed(picture, static_cast<Stream>(stream), part));
  return seeds;
}

// Adding stream numbers to seeds would fail: stream 7 of seed 3 would equal stream 6 of seed 4.
TEST(RandomStreams, NoTwoAreTheSameForAnySeedOrPart) {
  std::vector<std::uint64_t> seeds = all_seeds(1000);
  const std::size_t count = seeds.size();
  EXPECT_EQ(count, 1001U * streams * 3U);
  std::sort(seeds.begin(), seeds.end());
  seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
  EXPECT_EQ(seeds.size(), count);
}

// Streams of neighbouring seeds are uncorrelated: correlation of n draws is below 4 / √n.
TEST(RandomStreams, NeighboursDoNotGoTogether) {
  constexpr int draws = 4096;
  const auto correlation = [](std::uint64_t a, std::uint64_t b) {
    double sum = 0.0;
    for (int k = 0; k < draws; ++k)
      sum += (random_uniform(a, k, 0) - 0.5) * (random_uniform(b, k, 0) - 0.5);
    return 12.0 * sum / draws;
  };
  const std::uint64_t here = stream_seed(7, Stream::wash);
  EXPECT_NEAR(correlation(here, here), 1.0, 0.06);
  EXPECT_NEAR(correlation(here, stream_seed(8, Stream::wash)), 0.0, 4.0 / 64.0);
  EXPECT_NEAR(correlation(here, stream_seed(7, Stream::meadow)), 0.0, 4.0 / 64.0);
  EXPECT_NEAR(correlation(here, stream_seed(7, Stream::wash, 1)), 0.0, 4.0 / 64.0);
}

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
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x, ++count)
      product +=
          gaussian_noise(1, 9.0 * x, 9.0 * y, 2.0) * gaussian_noise(2, 9.0 * x, 9.0 * y, 2.0);
  EXPECT_NEAR(product / count, 0.0, 4.0 / 60.0);
}

}  // namespace
}  // namespace belvedere
