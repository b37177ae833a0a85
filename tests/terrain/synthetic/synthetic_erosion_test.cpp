#include "terrain/synthetic/synthetic_erosion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <queue>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "base/rising_queue.h"
#include "terrain/synthetic/synthetic_plan.h"

namespace belvedere::synthetic {
namespace {

// The flood itself, cell by cell.
Drainage flood(Grid<float>& altitude_m, const std::vector<std::int32_t>& outlets,
               std::uint64_t seed) {
  const int width = altitude_m.width();
  const auto for_neighbours = [&](std::int32_t i, auto&& f) {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if ((dx != 0 || dy != 0) && altitude_m.contains(i % width + dx, i / width + dy))
          f(i + dy * width + dx, dx != 0 && dy != 0);
  };
  Drainage drainage;
  drainage.receiver.assign(altitude_m.size(), -2);
  std::priority_queue<std::uint64_t, std::vector<std::uint64_t>, std::greater<>> front;
  const auto reach = [&](std::int32_t i, std::int32_t from) {
    if (drainage.receiver[at(i)] != -2) return;
    drainage.receiver[at(i)] = from;
    if (from >= 0) altitude_m[at(i)] = std::max(altitude_m[at(i)], altitude_m[at(from)]);
    front.push(rising_key(altitude_m[at(i)], static_cast<std::uint32_t>(i)));
  };
  for (const std::int32_t i : outlets) reach(i, -1);
  while (!front.empty()) {
    const auto i = static_cast<std::int32_t>(front.top() & 0xffffffffU);
    front.pop();
    drainage.order.push_back(i);
    for_neighbours(i, [&](std::int32_t j, bool) { reach(j, i); });
  }
  for (const std::int32_t i : drainage.order) {
    if (drainage.receiver[at(i)] < 0) continue;
    const float diagonal =
        1.F / (2.F - static_cast<float>(random_uniform(seed, i % width, i / width)));
    float steepest = 0.F;
    for_neighbours(i, [&](std::int32_t j, bool is_diagonal) {
      const float drop = (altitude_m[at(i)] - altitude_m[at(j)]) * (is_diagonal ? diagonal : 1.F);
      if (drop > steepest) drainage.receiver[at(i)] = j;
      steepest = std::max(steepest, drop);
    });
  }
  return drainage;
}

// Random whole metres: the fewer there are, the more flats and pits.
Grid<float> rough(int width, int height, int metres, std::uint64_t seed) {
  Grid<float> z(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      z(x, y) =
          static_cast<float>(static_cast<int>(random_uniform(seed, x, y) * metres) - metres / 3);
  return z;
}

TEST(SyntheticDrainage, IsThatOfAFlood) {
  struct Case {
    std::string name;
    int width, height, metres;
    std::vector<std::int32_t> outlets;
  };
  const std::vector<Case> cases = {{"rough", 97, 61, 1 << 22, {0, 96, 40 * 97}},
                                   {"many flats", 97, 61, 3, {50, 97 * 61 - 1}},
                                   {"one flat", 40, 33, 1, {40 * 20 + 7, 12}},
                                   {"terraces", 130, 90, 40, {0, 1, 131, 64}},
                                   {"outlets that stand high", 64, 64, 900, {5, 2080}},
                                   {"named twice", 31, 17, 5, {9, 9, 30}},
                                   {"a row", 300, 1, 7, {130}},
                                   {"a column", 1, 300, 7, {299}},
                                   {"two rows", 50, 2, 4, {3, 77}},
                                   {"one cell", 1, 1, 5, {0}}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const Grid<float> ground = rough(c.width, c.height, c.metres, seed);
      Grid<float> expected_m = ground;
      const Drainage expected = flood(expected_m, c.outlets, seed);
      Grid<float> filled_m = ground;
      const Drainage found = find_drainage(filled_m, c.outlets, seed);
      ASSERT_TRUE(std::ranges::equal(filled_m, expected_m));
      ASSERT_THAT(found.order, testing::ElementsAreArray(expected.order));
      ASSERT_THAT(found.receiver, testing::ElementsAreArray(expected.receiver));
    }
  }
}

TEST(SyntheticDrainage, IsTheSameForAnyNumberOfThreads) {
  const Grid<float> ground = rough(211, 190, 60, 8);
  const auto drain = [&](int threads) {
    const ThreadLimit limit(threads);
    Grid<float> filled_m = ground;
    return find_drainage(filled_m, {3, 9000}, 4);
  };
  const Drainage one = drain(1);
  const Drainage four = drain(4);
  EXPECT_EQ(one.order, four.order);
  EXPECT_EQ(one.receiver, four.receiver);
}

// A row that falls to the west, with a river that enters at its fourth cell.
TEST(SyntheticDrainage, CatchmentsAddUpDownstream) {
  Grid<float> z(5, 1);
  for (int x = 0; x < 5; ++x) z(x, 0) = static_cast<float>(x);
  const Drainage drainage = find_drainage(z, {0}, 1);
  Grid<float> inflow(5, 1, 0.F);
  inflow(3, 0) = 10.F;
  const Grid<float> km2 = catchments_km2(drainage, inflow, 1000.0);
  EXPECT_THAT(std::vector<float>(km2.begin(), km2.end()),
              testing::ElementsAre(15.F, 14.F, 13.F, 12.F, 1.F));
}

}  // namespace
}  // namespace belvedere::synthetic
