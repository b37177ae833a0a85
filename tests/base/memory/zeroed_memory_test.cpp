#include "base/memory/zeroed_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"

namespace belvedere {
namespace {

constexpr std::size_t large = (std::size_t{40} << 20) + 12345;

TEST(ZeroedMemory, IsZeroAlsoWhereOthersWroteBefore) {
  for (const std::size_t bytes :
       {std::size_t{0}, std::size_t{1}, std::size_t{4000}, std::size_t{300000}, large})
    for (int turn = 0; turn < 3; ++turn) {
      auto* const memory = static_cast<unsigned char*>(allocate_zeroed(bytes));
      ASSERT_TRUE(std::all_of(memory, memory + bytes, [](unsigned char c) { return c == 0; }))
          << bytes << ", turn " << turn;
      std::fill(memory, memory + bytes, static_cast<unsigned char>(255));
      free_zeroed(memory, bytes);
    }
}

TEST(ZeroedMemory, MoreThanThereIsIsRefused) {
  EXPECT_THROW(allocate_zeroed(std::size_t{1} << 60), std::bad_alloc);
}

TEST(ZeroedAllocator, ElementsWithInitializersAreMade) {
  struct Depth {
    float m = 7.0F;
  };
  const std::vector<Depth, ZeroedAllocator<Depth>> depths(5);
  for (const Depth& depth : depths) EXPECT_EQ(depth.m, 7.0F);
  const std::vector<std::vector<int>, ZeroedAllocator<std::vector<int>>> lists(
      3, std::vector<int>{1, 2});
  EXPECT_EQ(lists[2], (std::vector<int>{1, 2}));
}

// A grid contains its requested value, whatever was in memory before.
TEST(ZeroedMemory, GridsHoldWhatTheyAreFilledWith) {
  struct Cover {
    std::int16_t kind = -3;
    bool operator==(const Cover&) const = default;
  };
  for (int turn = 0; turn < 2; ++turn) {
    Grid<glm::vec3> zeros(2100, 2000);
    Grid<float> negative_zeros(10, 10, -0.0F);
    Grid<float> ones(2100, 2300, 1.0F);
    Grid<Cover> covers(40, 30);
    Grid<Cover> plain(40, 30, Cover{.kind = 0});
    EXPECT_TRUE(
        std::all_of(zeros.begin(), zeros.end(), [](glm::vec3 v) { return v == glm::vec3(0.0F); }));
    EXPECT_TRUE(std::all_of(negative_zeros.begin(), negative_zeros.end(),
                            [](float v) { return std::signbit(v); }));
    EXPECT_TRUE(std::all_of(ones.begin(), ones.end(), [](float v) { return v == 1.0F; }));
    EXPECT_TRUE(std::all_of(covers.begin(), covers.end(), [](Cover c) { return c.kind == -3; }));
    EXPECT_TRUE(std::all_of(plain.begin(), plain.end(), [](Cover c) { return c.kind == 0; }));
    const Grid<float> copy = ones;
    EXPECT_EQ(copy, ones);
    Grid<Cover> other(3, 2);
    other = covers;
    EXPECT_EQ(other, covers);
    std::fill(zeros.begin(), zeros.end(), glm::vec3(9.0F));
    std::fill(ones.begin(), ones.end(), 9.0F);
  }
}

}  // namespace
}  // namespace belvedere
