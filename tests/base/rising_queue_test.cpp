#include "base/rising_queue.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <queue>
#include <vector>

#include "base/random.h"

namespace belvedere {
namespace {

using Heap = std::priority_queue<std::uint64_t, std::vector<std::uint64_t>, std::greater<>>;

TEST(RisingQueue, KeysSortAsFloatsAndThenByIndex) {
  const float infinity = std::numeric_limits<float>::infinity();
  const float rising[] = {-infinity, -9000.F, -1.5F, -1e-30F, 0.F, 1e-30F, 0.25F, 4000.F, infinity};
  for (std::size_t i = 1; i < std::size(rising); ++i)
    EXPECT_LT(rising_key(rising[i - 1], 7), rising_key(rising[i], 3)) << rising[i];
  EXPECT_LT(rising_key(12.F, 3), rising_key(12.F, 4));
  EXPECT_EQ(rising_key(-0.F, 5), rising_key(0.F, 5));
}

TEST(RisingQueue, GivesTheOrderOfAHeapWhereAFrontRises) {
  // As in a flood: each popped key adds up to three keys that are slightly higher, some of them at
  // the same altitude with a lower index.
  RisingQueue queue;
  Heap heap;
  const auto push = [&](std::uint64_t key) {
    queue.push(key);
    heap.push(key);
  };
  for (std::uint32_t i = 0; i < 3000; ++i)
    push(rising_key(static_cast<float>(1000.0 * random_uniform(1, i, 0)), i));
  for (std::uint32_t step = 0; step < 60000 && !heap.empty(); ++step) {
    ASSERT_FALSE(queue.empty());
    const std::uint64_t key = heap.top();
    heap.pop();
    ASSERT_EQ(queue.pop(), key) << step;
    if (step > 40000) continue;
    const double level = 20.0 * static_cast<double>(step) / 1000.0;
    for (std::uint32_t k = 0; k < random_index(4, 2, step, 0); ++k) {
      const std::uint32_t index = random_index(1U << 20, 3, step, k);
      push(random_index(4, 4, step, k) == 0
               ? (key & ~std::uint64_t{0xffffffff}) | index
               : rising_key(static_cast<float>(level + 1000.0 + 90.0 * random_uniform(5, step, k)),
                            index));
    }
  }
  while (!heap.empty()) {
    ASSERT_EQ(queue.pop(), heap.top());
    heap.pop();
  }
  EXPECT_TRUE(queue.empty());
}

TEST(RisingQueue, TakesAnyOrder) {
  RisingQueue queue;
  Heap heap;
  for (std::int64_t i = 0; i < 20000; ++i) {
    const std::uint64_t key = i % 1000 < 2 ? (i % 2 == 0 ? 0 : ~std::uint64_t{0})
                                           : random_bits(6, i, 0) >> random_index(64, 7, i, 0);
    queue.push(key);
    heap.push(key);
    if (i % 3 == 0) continue;
    ASSERT_EQ(queue.pop(), heap.top());
    heap.pop();
  }
  while (!heap.empty()) {
    ASSERT_EQ(queue.pop(), heap.top());
    heap.pop();
  }
  EXPECT_TRUE(queue.empty());
}

}  // namespace
}  // namespace belvedere
