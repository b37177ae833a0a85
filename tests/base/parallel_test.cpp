#include "base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/grid.h"
#include "tests/grids.h"

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
      for (const auto [x, y] : test::cells(r)) ++visits(x, y);
    });
    EXPECT_EQ(visits, Grid<int>(101, 67, 1)) << tile;
  }
}

TEST(DeterministicSum, SameBitsForAnyThreadCount) {
  // Numbers whose float sum depends on its order.
  const auto term = [](std::size_t i) {
    return std::sin(static_cast<double>(i)) * std::pow(10.0, static_cast<double>(i % 17));
  };
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return deterministic_sum(100003, term);
  };
  const double once = run(1);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(run(2), once);
}

TEST(DeterministicSum, IsTheSum) {
  EXPECT_EQ(deterministic_sum(0, [](std::size_t) { return 1.0; }), 0.0);
  for (const std::size_t n : {1UL, 8191UL, 8192UL, 8193UL, 50000UL})
    EXPECT_EQ(deterministic_sum(n, [](std::size_t i) { return static_cast<double>(i); }),
              0.5 * static_cast<double>(n) * static_cast<double>(n - 1));
}

// A task that throws cancels its own loop, never a loop inside another task, whose caller expects
// it to be complete.
TEST(ParallelRanges, AnExceptionDoesNotCutShortTheLoopsOfOtherTasks) {
  using namespace std::chrono_literals;
  std::atomic<bool> thrown{false};
  std::atomic<int> started{0};
  std::atomic<int> finished{0};
  const auto task = [&](int begin, int) {
    if (begin == 0) {
      for (int i = 0; i < 200 && started == 0; ++i)
        std::this_thread::sleep_for(1ms);  // for another thread, where there is one
      thrown = true;
      throw std::runtime_error("stopped");
    }
    ++started;
    for (int i = 0; i < 200 && !thrown; ++i) std::this_thread::sleep_for(1ms);
    std::this_thread::sleep_for(5ms);  // by now the loop around this task is cancelled
    std::atomic<int> visited{0};
    parallel_ranges(1000, 1, [&](int from, int to) { visited += to - from; });
    if (visited == 1000) ++finished;
  };
  EXPECT_THROW(parallel_ranges(2, 1, task), std::runtime_error);
  EXPECT_EQ(finished, started);
}

int twice(FunctionRef<int(int)> f, int value) { return f(f(value)); }

TEST(FunctionRef, CallsWhatItRefersTo) {
  int calls = 0;
  const auto add = [&calls](int value) {
    ++calls;
    return value + 10;
  };
  EXPECT_EQ(twice(add, 1), 21);
  EXPECT_EQ(calls, 2);
}

TEST(FunctionRef, CopiesReferToTheSameFunction) {
  int count = 0;
  auto counter = [count]() mutable { return ++count; };  // a copy of it would count by itself
  const FunctionRef<int()> first = counter;
  const FunctionRef<int()> second = first;
  EXPECT_EQ(first(), 1);
  EXPECT_EQ(second(), 2);
  EXPECT_EQ(counter(), 3);
}

}  // namespace
}  // namespace belvedere
