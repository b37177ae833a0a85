#include "texture/synthesis/synth_surroundings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "tests/texture/synthesis/noise_plane.h"

namespace belvedere::synth {
namespace {

using namespace test;

TEST(Surroundings, AreTheCountsOfTheWindow) {
  const Plane plane = noise_plane({{150, 140}, {33, 20}}, 0, 5, true);
  for (const int radius : {2, 8}) {
    const std::vector<Surroundings> around = make_surroundings(plane, radius, classes);
    for (int p = 0; p < 2; ++p) {
      const Plane::Part& part = plane.parts[static_cast<std::size_t>(p)];
      for (int y = 0; y < part.height; y += 3) {
        for (int x = 0; x < part.width; x += 5) {
          const std::uint32_t own = class_of(plane.words[plane.index(p, x, y)]);
          if (own == no_class) continue;
          std::array<int, classes> counts{};
          for (int j = std::max(0, y - radius); j <= std::min(part.height - 1, y + radius); ++j) {
            for (int i = std::max(0, x - radius); i <= std::min(part.width - 1, x + radius); ++i) {
              const std::uint32_t c = class_of(plane.words[plane.index(p, i, j)]);
              if (c != no_class) ++counts[c];
            }
          }
          const int total = counts[0] + counts[1] + counts[2];
          const Surroundings found = around[plane.index(p, x, y)];
          ASSERT_EQ(found.others, 255 * (total - counts[own]) / total) << x << ", " << y;
          if (total == counts[own]) continue;
          ASSERT_NE(found.commonest, own);
          for (std::uint32_t c = 0; c < classes; ++c) {
            if (c != own) {
              ASSERT_GE(counts[found.commonest], counts[c]);
            }
          }
        }
      }
    }
  }
}

// Where no more than two classes meet, the price is that of all class counts.
TEST(Surroundings, PriceIsTheSquaredDifferenceOfCounts) {
  const SurroundingsPrice price(256, std::vector<std::uint8_t>(16, 16), 4);
  const auto counts = [](Surroundings s) {
    std::array<std::int64_t, 4> n{255 - s.others, 0, 0, 0};
    n[s.commonest] += s.others;
    return n;
  };
  for (int u = 0; u <= 255; u += 15) {
    for (int v = 0; v <= 255; v += 17) {
      for (const std::uint8_t a : {std::uint8_t{1}, std::uint8_t{2}}) {
        const Surroundings requested{static_cast<std::uint8_t>(u), a};
        const Surroundings offered{static_cast<std::uint8_t>(v), 2};
        std::int64_t sum = 0;
        for (std::size_t k = 0; k < 4; ++k)
          sum += (counts(requested)[k] - counts(offered)[k]) * (counts(requested)[k] - counts(offered)[k]);
        ASSERT_EQ(price(requested, offered), sum);
      }
    }
  }
  // Classes said to be alike count as one.
  const SurroundingsPrice alike(256, std::vector<std::uint8_t>(16, 0), 4);
  EXPECT_EQ(alike({100, 1}, {100, 2}), 0);
  EXPECT_EQ(alike({100, 1}, {90, 2}), 200);
}

}  // namespace
}  // namespace belvedere::synth
