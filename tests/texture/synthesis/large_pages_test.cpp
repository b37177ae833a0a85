#include "texture/synthesis/large_pages.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <numeric>
#include <string>

namespace belvedere {
namespace {

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
