#include "texture/synthesis/synth_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/random.h"
#include "tests/texture/synthesis/noise_plane.h"

namespace belvedere::synth {
namespace {

using namespace test;

TEST(Pieces, EqualAFloodFillForAnyBand) {
  const Plane exemplars = noise_plane({{150, 140}}, 0, 5, false);
  const Plane target = noise_plane({{70, 140}}, 0, 50, false);  // several bands of rows
  std::vector<std::uint32_t> match(target.words.size(), exemplars.nowhere());
  // Blocks of constant offset that touch in all combinations.
  const auto offset = [](int x, int y) {
    return static_cast<int>(random_index(3, 11, x / 6, y / 9));
  };
  for (int y = 0; y < 140; ++y)
    for (int x = 0; x < 70; ++x)
      match[target.index(0, x, y)] = exemplars.index(0, x + 9 * offset(x, y), y);
  Pieces pieces(target);
  pieces.find(target, exemplars, match);
  Grid<int> seen(70, 140, -1);
  std::uint32_t largest = 0;
  for (int y = 0; y < 140; ++y)
    for (int x = 0; x < 70; ++x) {
      if (seen(x, y) >= 0) continue;
      std::vector<std::pair<int, int>> open{{x, y}};
      seen(x, y) = 1;
      for (std::size_t i = 0; i < open.size(); ++i)
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
          const int nx = open[i].first + dx;
          const int ny = open[i].second + dy;
          if (!seen.contains(nx, ny) || seen(nx, ny) >= 0 || offset(nx, ny) != offset(x, y))
            continue;
          seen(nx, ny) = 1;
          open.emplace_back(nx, ny);
        }
      largest = std::max(largest, static_cast<std::uint32_t>(open.size()));
      for (const auto& [px, py] : open) {
        ASSERT_EQ(pieces.size()[target.index(0, px, py)], open.size());
        ASSERT_EQ(pieces.first_pixel(target.index(0, px, py)), target.index(0, x, y));
      }
    }
  EXPECT_EQ(pieces.largest(), largest);
  EXPECT_GT(largest, 64U);
}

}  // namespace
}  // namespace belvedere::synth
