#include "texture/synthesis/synth_bins.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace belvedere::synth {
namespace {

TEST(Bins, WhatStaysTooOftenGrowsDearerUpToABound) {
  // Used twice as often as expected, as often, never: 15000, 0 and -15000 at once, a sixteenth more
  // each round.
  const std::vector<std::int32_t> expected{9996, 996, 9996};
  const std::vector<std::int32_t> actual{19996, 996, 0};
  std::vector<std::int32_t> kept(3, 0);
  for (int round = 1; round <= 40; ++round) {
    const std::vector<std::int32_t> costs = steer_bins(actual, expected, 15000, kept);
    EXPECT_EQ(costs[0], 15000 + std::min(30000, round * 937));
    EXPECT_EQ(costs[1], 0);
    // 16 × 9996 / 10000, towards zero, is 15 sixteenths.
    EXPECT_EQ(costs[2], -14062 - std::min(30000, round * 878));
  }
}

TEST(Bins, ABorderOfClassesIsNoContrast) {
  // Class 0: above, calm; below, busy; on its right a class that is far brighter.
  Plane exemplars = make_plane({{40, 40}}, 0);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      const std::uint32_t grey = x >= 20  ? 250U
                                 : y < 20 ? 100U + static_cast<std::uint32_t>((x ^ y) & 1)
                                          : 80U + 40U * ((x ^ y) & 1);
      exemplars.words[exemplars.index(0, x, y)] = grey * 0x010101U | (x >= 20 ? 1U << 24 : 0U);
    }
  }
  pad(exemplars);
  const std::vector<std::uint8_t> bins = make_bins(exemplars, 2);
  const auto contrast = [&](int x, int y) { return bins[exemplars.index(0, x, y)] % 8; };
  for (int y = 4; y < 16; ++y) {
    EXPECT_EQ(contrast(19, y), contrast(8, y)) << y;
    EXPECT_LT(contrast(19, y), std::min(contrast(8, y + 20), contrast(19, y + 20))) << y;
  }
}

}  // namespace
}  // namespace belvedere::synth
