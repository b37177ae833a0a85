#include "renderer/ground/braided_rivers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

namespace belvedere {
namespace {

constexpr double braid_half_m = 20.0;
constexpr std::size_t braid_count = 400;

// Straight to the south, 40 m wide; east is on its left.
CoverRiver straight_south(std::size_t from = 0) {
  CoverRiver river;
  for (std::size_t i = from; i < braid_count; ++i) {
    river.positions.emplace_back(500.0, 8000.0 - 20.0 * static_cast<double>(i));
    river.half_width_m.push_back(static_cast<float>(braid_half_m));
  }
  return river;
}

std::vector<CoverRiver> braided(const CoverRiver& river, std::uint64_t seed,
                                double units_per_m = 0.1, double floor_half_m = 1e6) {
  const std::vector<CoverRiver> rivers{river};
  return braid_rivers(
      rivers,
      {.seed = seed,
       .units_per_m =
           [&](std::size_t) { return std::vector<double>(river.positions.size(), units_per_m); },
       .is_floor = [&](glm::dvec2 from,
                       glm::dvec2 to) { return glm::length(to - from) <= floor_half_m; }});
}

struct Section {
  double low_m, high_m;  // of a thread, east of the line
};
// The waters of a section, those that touch joined, from west to east.
std::vector<Section> threads_at(const std::vector<CoverRiver>& lines, std::size_t i) {
  std::vector<Section> threads;
  for (std::size_t n = 2; n < lines.size(); ++n) {
    const auto half = static_cast<double>(lines[n].half_width_m[i]);
    threads.push_back(
        {lines[n].positions[i].x - 500.0 - half, lines[n].positions[i].x - 500.0 + half});
  }
  std::sort(threads.begin(), threads.end(),
            [](const Section& a, const Section& b) { return a.low_m < b.low_m; });
  std::vector<Section> joined;
  for (const Section& one : threads)
    if (joined.empty() || one.low_m > joined.back().high_m)
      joined.push_back(one);
    else
      joined.back().high_m = std::max(joined.back().high_m, one.high_m);
  return joined;
}

TEST(BraidedRivers, PartAndMeetOnTheirGravel) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const std::vector<CoverRiver> lines = braided(straight_south(), seed);
    ASSERT_EQ(lines.size(), 5U) << "gravel, the line, three threads";
    const CoverRiver& gravel = lines[0];
    EXPECT_EQ(gravel.painted_as, LandCoverClass::sand);
    EXPECT_EQ(lines[1].painted_as, LandCoverClass::water);
    EXPECT_EQ(lines[1].half_width_m[braid_count / 2], 0.0F) << "its threads replace it";
    EXPECT_EQ(lines[1].half_width_m.front(), straight_south().half_width_m.front());
    std::array<double, 3> share{};
    double changes = 0.0;
    double narrowest_m = 1e9;
    double broadest_m = 0.0;
    constexpr std::size_t from = 60;
    constexpr std::size_t to = 320;
    for (std::size_t i = from; i < to; ++i) {
      const std::vector<Section> threads = threads_at(lines, i);
      const double edge_m = static_cast<double>(gravel.half_width_m[i]) + 1e-3;
      EXPECT_GT(edge_m, 3.0 * braid_half_m) << i;
      EXPECT_GE(threads.front().low_m, -edge_m) << i;
      EXPECT_LE(threads.back().high_m, edge_m) << i;
      share[threads.size() - 1] += 1.0 / static_cast<double>(to - from);
      if (threads.size() != threads_at(lines, i + 1).size()) changes += 1.0;
      for (const Section& one : threads) {
        narrowest_m = std::min(narrowest_m, one.high_m - one.low_m);
        broadest_m = std::max(broadest_m, one.high_m - one.low_m);
      }
    }
    EXPECT_GT(share[0], 0.1) << "they meet";
    EXPECT_GT(share[1], 0.2);
    EXPECT_GT(share[2], 0.02);
    const double widths = 20.0 * static_cast<double>(to - from) / (2.0 * braid_half_m);
    EXPECT_GT(widths / changes, 2.0) << "widths from one place where threads part or meet on";
    EXPECT_LT(widths / changes, 8.0);
    EXPECT_GT(broadest_m, 2.0 * narrowest_m);
  }
}

TEST(BraidedRivers, NeedAFloorAndRoomOnTheSheet) {
  EXPECT_EQ(braided(straight_south(), 1, 0.1, 1.9 * braid_half_m).size(), 1U) << "a narrow valley";
  EXPECT_EQ(braided(straight_south(), 1, 0.03).size(), 1U) << "a hair on the sheet";
  const std::vector<CoverRiver> narrow = braided(straight_south(), 1, 0.1, 3.1 * braid_half_m);
  ASSERT_EQ(narrow.size(), 5U);
  for (const float half : narrow[0].half_width_m) EXPECT_LE(half, 3.0 * braid_half_m);
}

TEST(BraidedRivers, HangOnThePlaceAlone) {
  const std::vector<CoverRiver> whole = braided(straight_south(), 1);
  const std::vector<CoverRiver> part = braided(straight_south(100), 1);
  ASSERT_EQ(part.size(), whole.size());
  for (std::size_t n = 2; n < whole.size(); ++n)
    for (std::size_t k = 50; k + 50 < part[n].positions.size(); ++k) {
      const std::size_t i = k + whole[n].positions.size() - part[n].positions.size();
      ASSERT_NEAR(glm::length(part[n].positions[k] - whole[n].positions[i]), 0.0, 1e-9);
      ASSERT_EQ(part[n].half_width_m[k], whole[n].half_width_m[i]);
    }
}

}  // namespace
}  // namespace belvedere
