#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/grid.h"

namespace belvedere {
namespace {

TEST(ThreadLimit, HoldsWhileItLives) {
  const int before = max_threads();
  {
    const ThreadLimit one(1);
    EXPECT_EQ(max_threads(), 1);
    const ThreadLimit more(7);  // the stricter one holds
    EXPECT_EQ(max_threads(), 1);
  }
  EXPECT_EQ(max_threads(), before);
  const ThreadLimit all(0);
  EXPECT_EQ(max_threads(), before);
}

TEST(ParallelRows, VisitsEachRowOnce) {
  std::vector<int> visits(1000, 0);
  parallel_rows(1000, [&](int y) { ++visits[static_cast<std::size_t>(y)]; });
  EXPECT_EQ(visits, std::vector<int>(1000, 1));
  parallel_rows(0, [](int) { FAIL(); });
}

TEST(ParallelRows, PassesErrorsOn) {
  EXPECT_THROW(parallel_rows(50,
                             [](int y) {
                               if (y == 31) throw std::runtime_error("row");
                             }),
               std::runtime_error);
}

TEST(ParallelTiles, CoverTheGridOnceWithoutOverlap) {
  for (const int tile : {1, 7, 32, 500}) {
    Grid<int> visits(101, 67);
    parallel_tiles(101, 67, tile, [&](PixelRect r) {
      EXPECT_LE(r.width(), tile);
      EXPECT_LE(r.height(), tile);
      EXPECT_EQ(r.x0 % tile, 0);
      EXPECT_EQ(r.y0 % tile, 0);
      for (int y = r.y0; y < r.y1; ++y) {
        for (int x = r.x0; x < r.x1; ++x) ++visits(x, y);
      }
    });
    EXPECT_EQ(visits, Grid<int>(101, 67, 1)) << tile;
  }
}

TEST(DeterministicSum, SameBitsForAnyThreadCount) {
  // Numbers whose float sum depends on its order.
  const auto term = [](std::size_t i) { return std::sin(static_cast<double>(i)) * std::pow(10.0, static_cast<double>(i % 17)); };
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return deterministic_sum(100003, term);
  };
  const double once = run(1);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(run(2), once);
}

TEST(DeterministicSum, IsTheSum) {
  EXPECT_EQ(deterministic_sum(0, [](std::size_t) { return 1.0; }), 0.0);
  for (const std::size_t n : {1UL, 8191UL, 8192UL, 8193UL, 50000UL}) {
    EXPECT_EQ(deterministic_sum(n, [](std::size_t i) { return static_cast<double>(i); }),
              0.5 * static_cast<double>(n) * static_cast<double>(n - 1));
  }
}

// A task that throws cancels its own loop, never a loop inside another task: whoever called that one believes that it was done.
TEST(ParallelRanges, AnExceptionDoesNotCutShortTheLoopsOfOtherTasks) {
  for (int round = 0; round < 20; ++round) {
    std::atomic<bool> thrown{false};
    std::atomic<int> cut_short{0};
    EXPECT_THROW(parallel_ranges(8, 1,
                                 [&](int begin, int) {
                                   if (begin == 0) {
                                     thrown = true;
                                     throw std::runtime_error("stopped");
                                   }
                                   std::vector<int> visited(20000, 0);

                                   parallel_ranges(20000, 1, [&](int from, int to) {
                                     for (int i = from; i != to; ++i) visited[static_cast<std::size_t>(i)] = 1;
                                   });
                                   for (const int v : visited)
                                     if (v == 0) {
                                       ++cut_short;
                                       break;
                                     }
                                 }),
                 std::runtime_error);
    EXPECT_EQ(cut_short, 0);
  }
}

}  // namespace
}  // namespace belvedere
