#include "texture/segment/superpixels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/parallel.h"
#include "base/random.h"
#include "tests/grids.h"

namespace belvedere {
namespace {

// Three flat regions with crooked borders.
int region(int x, int y) { return y < 30 + (x / 7) % 3 ? 0 : (x < 70 ? 1 : 2); }
Grid<glm::vec3> flat_regions(int width, int height) {
  const glm::vec3 colours[3] = {{.8F, 0.F, -.1F}, {.4F, .1F, .1F}, {.4F, -.1F, .1F}};
  return test::grid_of<glm::vec3>(width, height,
                                  [&](int x, int y) { return colours[region(x, y)]; });
}

Grid<glm::vec3> noise(int width, int height) {
  Grid<glm::vec3> out(width, height);
  for (const auto [x, y] : test::cells(width, height))
    for (int c = 0; c < 3; ++c)
      out(x, y)[c] =
          static_cast<float>(random_index(1000, static_cast<std::uint64_t>(c), x / 3, y / 3)) /
          1000.F;
  return out;
}

TEST(Superpixels, FlatRegionsAreFoundToThePixel) {
  const Grid<glm::vec3> picture = flat_regions(120, 90);
  const Superpixels found = find_superpixels(picture, {.count = 3, .cells = 300, .blur_px = 0.0});
  ASSERT_EQ(found.count, 3U);
  for (const auto [x, y] : test::cells(120, 90))
    EXPECT_EQ(found.of(x, y), region(x, y)) << x << " " << y;
}

TEST(Superpixels, PiecesAreConnectedCountedAndInOrder) {
  const Superpixels found = find_superpixels(noise(90, 70), {.count = 40, .cells = 200});
  EXPECT_EQ(found.count, 40U);
  // As many connected pieces as there are numbers.
  Grid<int> met(90, 70, 0);
  std::size_t connected = 0;
  std::uint16_t next = 0;
  for (const auto [x, y] : test::cells(90, 70)) {
    if (met(x, y) != 0) continue;
    EXPECT_EQ(found.of(x, y), next++);
    ++connected;
    std::vector<std::pair<int, int>> open = {{x, y}};
    while (!open.empty()) {
      const auto [px, py] = open.back();
      open.pop_back();
      if (!met.contains(px, py) || met(px, py) != 0 || found.of(px, py) != found.of(x, y)) continue;
      met(px, py) = 1;
      for (const auto& [dx, dy] :
           {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)})
        open.emplace_back(px + dx, py + dy);
    }
  }
  EXPECT_EQ(connected, found.count);
}

TEST(Superpixels, OneColourAndFewPixels) {
  EXPECT_EQ(find_superpixels(Grid<glm::vec3>(40, 40, glm::vec3(.5F)), {.count = 12}).count, 12U);
  const Superpixels tiny = find_superpixels(flat_regions(3, 2), {.count = 400, .blur_px = 0.0});
  EXPECT_LE(tiny.count, 6U);
  EXPECT_GE(tiny.count, 1U);
}

TEST(Superpixels, SameForAnyThreads) {
  const auto made = [](int threads) {
    const ThreadLimit limit(threads);
    return find_superpixels(noise(100, 80), {}).of;
  };
  EXPECT_EQ(made(1), made(2));
}

using ::testing::ElementsAre;

// Sum of the weights of all pairs that share a group.
double partition_objective(const PairWeights& weights, const Partition& groups) {
  double sum = 0.0;
  for (std::size_t a = 0; a < weights.count(); ++a)
    for (std::size_t b = a + 1; b < weights.count(); ++b)
      if (groups[a] == groups[b]) sum += weights(a, b);
  return sum;
}

// The highest objective of all partitions, by growth strings: thing i joins one of the earlier
// groups or begins the next.
double best_of_all(const PairWeights& weights, Partition& groups, std::size_t i,
                   std::uint16_t used) {
  if (i == weights.count()) return partition_objective(weights, groups);
  double best = -1e300;
  for (std::uint16_t g = 0; g <= used; ++g) {
    groups[i] = g;
    best = std::max(best, best_of_all(weights, groups, i + 1,
                                      static_cast<std::uint16_t>(std::max<int>(used, g + 1))));
  }
  return best;
}

PairWeights random_weights(std::size_t count, std::uint64_t seed) {
  PairWeights weights(count);
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = a + 1; b < count; ++b)
      weights.set(
          a, b,
          static_cast<double>(random_index(2001, seed, static_cast<int>(a), static_cast<int>(b))) -
              1000.0);
  return weights;
}

TEST(CliquePartition, TwoCamps) {
  PairWeights weights(5);
  for (std::size_t a = 0; a < 5; ++a)
    for (std::size_t b = a + 1; b < 5; ++b) weights.set(a, b, (a % 2 == b % 2) ? 1.0 : -1.0);
  EXPECT_THAT(partition_cliques(weights), ElementsAre(0, 1, 0, 1, 0));
  EXPECT_DOUBLE_EQ(partition_objective(weights, partition_cliques(weights)), 4.0);
}

TEST(CliquePartition, WithoutFriendsEachStandsAlone) {
  PairWeights weights(4);
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = a + 1; b < 4; ++b) weights.set(a, b, -0.5);
  EXPECT_THAT(partition_cliques(weights), ElementsAre(0, 1, 2, 3));
}

// Merging alone fails here: 0 and 1 merge first, although 1 fits better with 2 and 3.
TEST(CliquePartition, MovesMendWhatJoiningDid) {
  PairWeights weights(4);
  weights.set(0, 1, 10);
  weights.set(1, 2, 8);
  weights.set(1, 3, 8);
  weights.set(2, 3, 1);
  weights.set(0, 2, -20);
  weights.set(0, 3, -20);
  EXPECT_THAT(join_by_mean_weight(weights), ElementsAre(0, 0, 1, 1));
  EXPECT_THAT(partition_cliques(weights), ElementsAre(0, 1, 1, 1));
}

// For 200 random graphs of eight things: never above the best, no move left, and on average within
// a tenth of the best.
TEST(CliquePartition, NearTheBestOfAllPartitions) {
  double found_sum = 0.0;
  double best_sum = 0.0;
  int exact = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const PairWeights weights = random_weights(8, seed);
    Partition all(8);
    const double best = best_of_all(weights, all, 0, 0);
    const Partition groups = partition_cliques(weights);
    const double found = partition_objective(weights, groups);
    EXPECT_LE(found, best + 1e-9);
    EXPECT_GE(found + 1e-9, partition_objective(weights, join_by_mean_weight(weights)));
    for (std::size_t i = 0; i < 8; ++i)
      for (std::uint16_t g = 0; g < 9; ++g) {
        Partition moved = groups;
        moved[i] = g;
        EXPECT_LE(partition_objective(weights, moved), found + 1e-6) << seed;
      }
    found_sum += found;
    best_sum += best;
    exact += found > best - 1e-9 ? 1 : 0;
  }
  EXPECT_GT(found_sum, 0.9 * best_sum);
  EXPECT_GT(exact, 60);
}

// The caches of merging do not change the result.
TEST(CliquePartition, JoiningTakesTheBestPairEachTime) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const PairWeights weights = random_weights(14, 500 + seed);
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < 14; ++i) groups.push_back({i});
    for (;;) {
      double highest = 0.0;
      std::size_t a = 0, b = 0;
      for (std::size_t p = 0; p < groups.size(); ++p)
        for (std::size_t q = p + 1; q < groups.size(); ++q) {
          double sum = 0.0;
          for (const std::size_t i : groups[p])
            for (const std::size_t j : groups[q]) sum += weights(i, j);
          if (const double mean = sum / static_cast<double>(groups[p].size() * groups[q].size());
              mean > highest + 1e-9) {
            highest = mean;
            a = p;
            b = q;
          }
        }
      if (a == b) break;
      groups[a].insert(groups[a].end(), groups[b].begin(), groups[b].end());
      groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(b));
    }
    Partition plain(14);
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (const std::size_t i : groups[g]) plain[i] = static_cast<std::uint16_t>(g);
    EXPECT_EQ(join_by_mean_weight(weights), in_order(plain)) << seed;
  }
}

}  // namespace
}  // namespace belvedere
