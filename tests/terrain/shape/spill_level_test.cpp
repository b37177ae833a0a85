#include "terrain/shape/spill_level.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <queue>
#include <set>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "base/random.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

// The flood itself, cell by cell.
Grid<float> flooded(Grid<float> z, const std::vector<std::int32_t>& outlets) {
  using Cell = std::pair<float, std::int32_t>;
  std::priority_queue<Cell, std::vector<Cell>, std::greater<>> front;
  std::set<std::int32_t> reached;
  for (const std::int32_t i : outlets)
    if (reached.insert(i).second) front.emplace(z[static_cast<std::size_t>(i)], i);
  while (!front.empty()) {
    const auto [level, i] = front.top();
    front.pop();
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int x = i % z.width() + dx;
        const int y = i / z.width() + dy;
        if (!z.contains(x, y) || !reached.insert(y * z.width() + x).second) continue;
        z(x, y) = std::max(z(x, y), level);
        front.emplace(z(x, y), y * z.width() + x);
      }
  }
  return z;
}

Grid<float> rough(int width, int height, int metres, std::uint64_t seed) {
  return test::grid_of(width, height, [&](int x, int y) {
    return static_cast<int>(random_uniform(seed, x, y) * metres) - metres / 3;
  });
}

TEST(SpillLevel, IsTheRimsLowestPlace) {
  Grid<float> bowl(9, 7, 10.F);
  bowl(4, 3) = -5.F;
  bowl(5, 3) = 2.F;
  bowl(8, 6) = 1.F;  // an outlet behind a pass
  bowl(6, 4) = 8.F;
  bowl(7, 5) = 4.F;
  fill_to_spill_level(bowl, std::vector<std::int32_t>{6 * 9 + 8});
  EXPECT_EQ(bowl(4, 3), 8.F);
  EXPECT_EQ(bowl(5, 3), 8.F);
  EXPECT_EQ(bowl(6, 4), 8.F);
  EXPECT_EQ(bowl(7, 5), 4.F);
  EXPECT_EQ(bowl(8, 6), 1.F);
  EXPECT_EQ(bowl(0, 0), 10.F);
}

TEST(SpillLevel, IsThatOfAFlood) {
  struct Case {
    int width, height, metres;
    std::vector<std::int32_t> outlets;
  };
  const std::vector<Case> cases = {{97, 61, 1 << 22, {0, 96, 40 * 97}},
                                   {150, 140, 3, {50, 97 * 61 - 1}},
                                   {40, 33, 1, {40 * 20 + 7, 12}},
                                   {130, 190, 40, {0, 1, 131, 64}},
                                   {64, 64, 900, {5, 2080, 5}},
                                   {300, 1, 7, {130}},
                                   {1, 300, 7, {299}},
                                   {50, 2, 4, {3, 77}},
                                   {2, 50, 4, {3, 77}},
                                   {3, 3, 9, {4}},
                                   {1, 1, 5, {0}}};
  for (const Case& c : cases)
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      Grid<float> filled = rough(c.width, c.height, c.metres, seed);
      const Grid<float> expected = flooded(filled, c.outlets);
      const ThreadLimit threads(seed % 2 == 0 ? 1 : 4);
      fill_to_spill_level(filled, c.outlets);
      ASSERT_TRUE(filled == expected) << c.width << " × " << c.height << ", " << seed;
    }
}

}  // namespace
}  // namespace belvedere
