#include "base/memory/zeroed_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <glm/vec3.hpp>
#include <numeric>
#include <string>
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

// Below and above the size from which threads share a block, with ends that are not a multiple of a
// share or a pattern.
const std::array<std::size_t, 6> sizes = {0, 1, 5, 5000, 1'500'001, 7'000'003};

struct Colour {
  std::array<unsigned char, 3> rgb;
  bool operator==(const Colour&) const = default;
};

TEST(ParallelFill, EveryValueIsWrittenAndNoneBeyond) {
  for (const std::size_t count : sizes) {
    std::vector<Colour> colours(count + 2, Colour{{1, 2, 3}});
    const Colour value{{7, 8, 9}};
    fill_in_parallel(colours.data() + 1, &value, sizeof value, count);
    EXPECT_EQ(std::count(colours.begin(), colours.end(), value), static_cast<std::ptrdiff_t>(count))
        << count;
    EXPECT_EQ(colours.front(), (Colour{{1, 2, 3}})) << count;
    EXPECT_EQ(colours.back(), (Colour{{1, 2, 3}})) << count;
  }
}

TEST(ParallelFill, ValuesLargerThanAPatternAreFilledToo) {
  using Large = std::array<int, 9000>;
  Large value{};
  std::iota(value.begin(), value.end(), 5);
  std::vector<Large> values(600);  // 21 MB
  fill_in_parallel(values.data(), value.data(), sizeof value, values.size());
  EXPECT_TRUE(
      std::all_of(values.begin(), values.end(), [&](const Large& v) { return v == value; }));
}

TEST(ParallelFill, ACopyIsWhatWasCopied) {
  for (const std::size_t count : sizes) {
    std::vector<int> from(count);
    std::iota(from.begin(), from.end(), 17);
    std::vector<int> to(count + 1, -1);
    copy_in_parallel(to.data(), from.data(), count * sizeof(int));
    EXPECT_TRUE(std::equal(from.begin(), from.end(), to.begin())) << count;
    EXPECT_EQ(to.back(), -1) << count;
  }
}

// KiB of this process's memory that lie in large pages.
long large_kib() {
  std::ifstream file("/proc/self/smaps_rollup");
  for (std::string word; file >> word;)
    if (word == "AnonHugePages:") {
      long kib = 0;
      file >> kib;
      return kib;
    }
  return -1;
}

bool system_takes_advice() {
  std::ifstream file("/sys/kernel/mm/transparent_hugepage/enabled");
  std::string all;
  std::getline(file, all);
  return all.find("[madvise]") != std::string::npos;
}

TEST(LargePages, HoldATableFromItsFirstValueOn) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{5}, std::size_t{16} << 20U}) {
    std::vector<std::uint32_t> values{1, 2, 3};
    const long before = large_kib();
    assign_in_large_pages(values, count, 7U);
    EXPECT_EQ(values, std::vector<std::uint32_t>(count, 7U));
    if (count > (1U << 20U) && before >= 0 && system_takes_advice()) {
      EXPECT_GT(large_kib(), before);
    }
  }
}

TEST(LargePages, HoldATableThatIsWrittenAlready) {
  std::vector<std::uint32_t> values(16U << 20U);
  std::iota(values.begin(), values.end(), 7U);
  const long before = large_kib();
  prefer_large_pages(values);
  for (std::size_t i = 0; i < values.size(); i += 4099) ASSERT_EQ(values[i], i + 7U);
  if (before < 0 || !system_takes_advice())
    GTEST_SKIP() << "this system gives no large pages on advice";
  EXPECT_GT(large_kib(), before) << "at least some of the 64 MiB";
}

TEST(LargePages, LeaveSmallAndEmptyBlocksAlone) {
  const std::vector<std::uint8_t> none;
  prefer_large_pages(none);
  const std::vector<std::uint8_t> some(5000, 3);
  prefer_large_pages(some);
  EXPECT_EQ(some[4999], 3);
}

}  // namespace
}  // namespace belvedere
