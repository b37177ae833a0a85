#include "base/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <set>
#include <vector>

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
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    for (std::int64_t x = -6; x < 6; ++x) {
      for (std::int64_t y = -6; y < 6; ++y) {
        for (std::uint64_t draw = 0; draw < 6; ++draw) seen.insert(random_bits(seed, x, y, draw));
      }
    }
  }
  EXPECT_EQ(seen.size(), 6U * 12 * 12 * 6);
}

TEST(Random, UniformFillsTheUnitIntervalEvenly) {
  std::array<int, 20> bins{};
  double sum = 0.0;
  const int side = 400;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double u = random_uniform(7, x, y);
      ASSERT_GE(u, 0.0);
      ASSERT_LT(u, 1.0);
      ++bins[static_cast<std::size_t>(u * 20.0)];
      sum += u;
    }
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
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double here = random_uniform(7, x, y) - 0.5;
      products[0] += here * (random_uniform(7, x + 1, y) - 0.5);
      products[1] += here * (random_uniform(7, x, y + 1) - 0.5);
      products[2] += here * (random_uniform(8, x, y) - 0.5);
      products[3] += here * (random_uniform(7, x, y, 1) - 0.5);
    }
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
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double n = random_normal(11, x, y);
      ASSERT_LE(std::abs(n), 3.4642);
      sum += n;
      squares += n * n;
      fourth += n * n * n * n;
    }
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

}  // namespace

}  // namespace belvedere
