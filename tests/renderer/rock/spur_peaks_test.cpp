#include "renderer/rock/spur_peaks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/random.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

constexpr std::uint32_t own_parent = 77;

// A height with its spur's number, by the definition in spurs.h: one spur after the other.
std::vector<std::pair<float, int>> heights_at(const SpurCells& cells, float slender,
                                              glm::vec2 position, float depth_m,
                                              std::uint32_t parent) {
  using namespace spur_form;
  const int column = static_cast<int>(std::floor(position.x / cells.spacing));
  const int row = static_cast<int>(std::floor(position.y / cells.spacing));
  std::vector<std::pair<float, int>> heights;
  for (const auto [x, y] : test::cells(cells.count.x, cells.count.y)) {
    if (std::abs(cells.first.x + x - column) > reach_across) continue;
    if (cells.first.y + y < row - reach_up || cells.first.y + y > row + reach_down) continue;
    const int number = y * cells.count.x + x;
    const Spur& spur = cells.spurs[static_cast<std::size_t>(number)];
    if (!spur.grown) continue;
    const glm::vec2 offset = (position - spur.position) * (1.0F / cells.spacing);
    if (std::abs(depth_m - spur.depth_m) >
        spur.tolerance_m * (stray + std::sqrt(offset.x * offset.x + offset.y * offset.y)))
      continue;
    const float v = (offset.x * spur.down.x + offset.y * spur.down.y) * slender;
    const float u = offset.x * spur.down.y - offset.y * spur.down.x;
    const float wide = std::abs(u);
    const float head = spur.skew_head * u - head_point * wide;
    const float tail = spur.length + spur.skew_foot * u + foot_point * wide;
    float height = spur.top;
    if (v < head)
      height += head_rise * (v - head);
    else if (v < tail || tail < head)
      height += back_rise * (v - head);
    else
      height += back_rise * (tail - head) - spur.foot * (v - tail);
    height -= spur.flank[u > 0.0F ? 1 : 0] /
              (opening + opening_along * std::clamp(v, opening_from, opening_to)) * wide;
    if (spur.parent != parent) height -= cells.lost_beyond;
    heights.emplace_back(height, number);
  }
  std::stable_sort(heights.begin(), heights.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  return heights;
}

// Spurs of any form, on two surfaces, with gaps; every seventh equals the one before it, so that
// heights are equal.
SpurCells any_spurs(glm::ivec2 count) {
  SpurCells cells;
  cells.spacing = 7.0F;
  cells.first = {-3, 5};
  cells.count = count;
  for (int y = 0; y < count.y; ++y)
    for (int x = 0; x < count.x; ++x) {
      std::uint64_t draws = 0;
      const auto between = [&](float low, float high) {
        return low + (high - low) * static_cast<float>(random_uniform(5, x, y, draws++));
      };
      Spur spur;
      spur.grown = between(0.0F, 1.0F) < 0.8F;
      spur.position.x =
          (static_cast<float>(cells.first.x + x) + between(0.0F, 1.0F)) * cells.spacing;
      spur.position.y =
          (static_cast<float>(cells.first.y + y) + between(0.0F, 1.0F)) * cells.spacing;
      const float turn = between(-1.0F, 1.0F);
      spur.down = {turn, std::sqrt(1.0F - turn * turn)};
      spur.top = between(0.0F, 0.9F);
      spur.flank = {between(0.7F, 1.6F), 1.1F};
      spur.length = between(0.2F, 1.5F);
      spur.foot = between(0.7F, 1.6F);
      spur.skew_foot = between(-0.35F, 0.35F);
      spur.skew_head = between(-0.35F, 0.35F);
      spur.depth_m = between(0.0F, 1.0F) < 0.5F ? 1000.0F : 1150.0F;
      spur.tolerance_m = 100.0F;
      spur.parent = between(0.0F, 1.0F) < 0.5F ? own_parent : 5U;
      spur.id = static_cast<std::uint32_t>(y * count.x + x + 1);
      if (spur.id % 7 == 0 && !cells.spurs.empty()) {
        const std::uint32_t id = spur.id;
        spur = cells.spurs.back();
        spur.id = id;
      }
      cells.spurs.push_back(spur);
    }
  cells.lanes = to_lanes(cells);
  return cells;
}

TEST(SpurPeaks, AreThoseOfALookAtOneAfterTheOther) {
  for (const glm::ivec2 count : {glm::ivec2(17, 13), glm::ivec2(2, 3), glm::ivec2(1, 9)}) {
    const SpurCells cells = any_spurs(count);
    int found = 0;
    int ties = 0;
    // Beyond the cells as well.
    for (float y = 20.1F; y < 150.0F; y += 0.83F)
      for (float x = -40.3F; x < 120.0F; x += 0.71F) {
        const float depth_m = 950.0F + 2.0F * x;
        const auto heights = heights_at(cells, 0.7F, {x, y}, depth_m, own_parent);
        const SpurPeaks peaks = find_peaks(cells, 0.7F, {x, y}, depth_m, own_parent);
        ASSERT_EQ(peaks.best, heights.empty() ? -1 : heights[0].second) << x << ' ' << y;
        ASSERT_EQ(peaks.next, heights.size() < 2 ? -1 : heights[1].second) << x << ' ' << y;
        ASSERT_EQ(peaks.next_height, heights.size() < 2 ? -1e9F : heights[1].first)
            << x << ' ' << y;
        found += heights.empty() ? 0 : 1;
        ties += heights.size() > 1 && heights[0].first == heights[1].first ? 1 : 0;
      }
    EXPECT_GT(found, 500);
    if (count.x > 2) {
      EXPECT_GT(ties, 500);
    }
  }
}

}  // namespace
}  // namespace belvedere
