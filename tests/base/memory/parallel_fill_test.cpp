#include "base/memory/parallel_fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace belvedere {
namespace {

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

}  // namespace
}  // namespace belvedere
