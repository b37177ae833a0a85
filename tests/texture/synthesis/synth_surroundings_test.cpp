#include "texture/synthesis/synth_surroundings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "tests/texture/synthesis/noise_plane.h"

namespace belvedere::synth {
namespace {

using namespace test;

std::array<int, classes> counts_around(const Plane& plane, int p, int x, int y, int radius) {
  const Plane::Part& part = plane.parts[static_cast<std::size_t>(p)];
  std::array<int, classes> counts{};
  for (int j = std::max(0, y - radius); j <= std::min(part.height - 1, y + radius); ++j)
    for (int i = std::max(0, x - radius); i <= std::min(part.width - 1, x + radius); ++i) {
      const std::uint32_t c = class_of(plane.words[plane.index(p, i, j)]);
      if (c != no_class) ++counts[c];
    }
  return counts;
}

TEST(Surroundings, AreTheCountsOfTheWindow) {
  const Plane plane = noise_plane({{150, 140}, {33, 20}}, 0, 5, true);
  for (const int radius : {2, 8}) {
    const std::vector<Surroundings> around = make_surroundings(plane, radius, classes);
    for (int p = 0; p < 2; ++p) {
      const Plane::Part& part = plane.parts[static_cast<std::size_t>(p)];
      for (int y = 0; y < part.height; y += 3)
        for (int x = 0; x < part.width; x += 5) {
          const std::uint32_t own = class_of(plane.words[plane.index(p, x, y)]);
          if (own == no_class) continue;
          const std::array<int, classes> counts = counts_around(plane, p, x, y, radius);
          const int total = counts[0] + counts[1] + counts[2];
          const Surroundings found = around[plane.index(p, x, y)];
          ASSERT_EQ(found.others, 255 * (total - counts[own]) / total) << x << ", " << y;
          if (total == counts[own]) continue;
          ASSERT_NE(found.commonest, own);
          for (std::uint32_t c = 0; c < classes; ++c)
            if (c != own) {
              ASSERT_GE(counts[found.commonest], counts[c]);
            }
        }
    }
  }
}

// Where at most two classes meet, the price is that of all class counts.
TEST(Surroundings, PriceIsTheSquaredDifferenceOfCounts) {
  const SurroundingsPrice price(256, std::vector<std::uint8_t>(16, 16), 4);
  const auto counts = [](Surroundings s) {
    std::array<std::int64_t, 4> n{255 - s.others, 0, 0, 0};
    n[s.commonest] += s.others;
    return n;
  };
  for (int u = 0; u <= 255; u += 15)
    for (int v = 0; v <= 255; v += 17)
      for (const std::uint8_t a : {std::uint8_t{1}, std::uint8_t{2}}) {
        const Surroundings requested{static_cast<std::uint8_t>(u), a};
        const Surroundings offered{static_cast<std::uint8_t>(v), 2};
        std::int64_t sum = 0;
        for (std::size_t k = 0; k < 4; ++k)
          sum += (counts(requested)[k] - counts(offered)[k]) *
                 (counts(requested)[k] - counts(offered)[k]);
        ASSERT_EQ(price(requested, offered), sum);
      }
  // Classes with dissimilarity 0 count as one.
  const SurroundingsPrice alike(256, std::vector<std::uint8_t>(16, 0), 4);
  EXPECT_EQ(alike({100, 1}, {100, 2}), 0);
  EXPECT_EQ(alike({100, 1}, {90, 2}), 200);
}

TEST(ClassShares, AreTheSharesOfTheWindow) {
  const Plane plane = noise_plane({{150, 140}, {33, 20}}, 0, 5, true);
  for (const int radius : {2, 8}) {
    const ClassShares shares(plane, radius, classes);
    EXPECT_LT(shares.kinds(), 3000U) << "equal neighbourhoods share a number";
    for (int p = 0; p < 2; ++p) {
      const Plane::Part& part = plane.parts[static_cast<std::size_t>(p)];
      for (int y = 0; y < part.height; y += 3)
        for (int x = 0; x < part.width; x += 5) {
          const std::uint32_t at = plane.index(p, x, y);
          if (class_of(plane.words[at]) == no_class) continue;
          const std::array<int, classes> counts = counts_around(plane, p, x, y, radius);
          const double total = counts[0] + counts[1] + counts[2];
          for (std::size_t c = 0; c < classes; ++c)
            ASSERT_NEAR(shares.of(shares.numbers()[at])[c], 255.0 * counts[c] / total,
                        255.0 / 128.0 + 1.0)
                << x << ", " << y;
        }
    }
    ThreadLimit one(1);
    const ClassShares again(plane, radius, classes);
    for (std::size_t i = 0; i < plane.words.size(); ++i)
      ASSERT_TRUE(again.numbers()[i].others == shares.numbers()[i].others &&
                  again.numbers()[i].commonest == shares.numbers()[i].commonest);
  }
}

// More kinds of neighbourhood than numbers: shares are quantized more coarsely.
TEST(ClassShares, OfAPictureWithoutEndAreCoarser) {
  constexpr int many = 24;
  Plane plane = make_plane({{420, 400}}, 0);
  plane.for_each(
      [&](std::uint32_t at) { plane.words[at] = random_index(many, 7, at / 3, 0) << 24; });
  pad(plane);
  const ClassShares shares(plane, 3, many);
  EXPECT_LE(shares.kinds(), 65536U);
  double off = 0.0;
  int counted = 0;
  for (int y = 0; y < 400; y += 7)
    for (int x = 3; x < 417; x += 5) {
      std::array<int, many> counts{};
      int total = 0;
      for (int j = std::max(0, y - 3); j <= std::min(399, y + 3); ++j)
        for (int i = x - 3; i <= x + 3; ++i, ++total)
          ++counts[class_of(plane.words[plane.index(0, i, j)])];
      for (std::size_t c = 0; c < many; ++c, ++counted)
        off += std::abs(shares.of(shares.numbers()[plane.index(0, x, y)])[c] -
                        255.0 * counts[c] / total);
    }
  EXPECT_LT(off / counted, 14.0);
}

// Σ_kl (1 - d_kl) δ_k δ_l, summed over all pairs.
TEST(ClassShares, PriceIsTheQuadraticFormOfTheirDifferences) {
  const std::vector<std::uint8_t> pairs{0, 16, 5, 16, 0, 9, 5, 9, 0};
  const SurroundingsPrice price(256, pairs, 3);
  const SurroundingsPrice dissimilar(256, std::vector<std::uint8_t>(9, 16), 3);
  for (int i = 0; i < 300; ++i) {
    const auto shares = [i](std::uint64_t seed) {
      const std::uint8_t a = static_cast<std::uint8_t>(random_index(256, seed, i, 0));
      const std::uint8_t b = static_cast<std::uint8_t>(random_index(256U - a, seed, i, 1));
      return std::array<std::uint8_t, 3>{a, b, static_cast<std::uint8_t>(255 - a - b)};
    };
    const std::array<std::uint8_t, 3> u = shares(3);
    const std::array<std::uint8_t, 3> v = shares(4);
    std::int64_t sum = 0;
    std::int64_t squares = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t l = 0; l < 3; ++l)
        sum += (k == l ? 16 : 16 - pairs[3 * k + l]) * (u[k] - v[k]) * (u[l] - v[l]);
      squares += (u[k] - v[k]) * (u[k] - v[k]);
    }
    EXPECT_EQ(shares_cost(u.data(), v.data(), price, 3), std::max<std::int64_t>(0, sum) >> 4);
    EXPECT_EQ(shares_cost(u.data(), v.data(), dissimilar, 3), squares);
    EXPECT_EQ(shares_cost(u.data(), u.data(), price, 3), 0);
  }
}

}  // namespace
}  // namespace belvedere::synth
