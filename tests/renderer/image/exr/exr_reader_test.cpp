#include "renderer/image/exr/exr_reader.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace belvedere {
namespace {

TEST(HalfFloats, EveryHalfComesBack) {
  for (std::uint32_t bits = 0; bits < 0x10000U; ++bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    float number = 0.F;
    from_halves(&half, 1, &number, 1);
    if (std::isnan(number)) continue;
    std::uint16_t back = 0;
    to_halves(&number, 1, 1, &back);
    ASSERT_EQ(back, half);
  }
}

TEST(HalfFloats, NumbersAreRoundedToTheNearestAndNeverBecomeInfinite) {
  const std::array<float, 8> numbers = {
      1.F, 9.F, 1.F + 0x1p-12F, 9.F, 1e6F, 9.F, std::numeric_limits<float>::infinity(), 9.F};
  std::array<std::uint16_t, 4> halves{};
  to_halves(numbers.data(), 2, 4, halves.data());
  std::array<float, 4> back{};
  from_halves(halves.data(), 4, back.data(), 1);
  EXPECT_EQ(back[0], 1.F);
  EXPECT_EQ(back[1], 1.F);
  EXPECT_EQ(back[2], 65504.F);
  EXPECT_TRUE(std::isinf(back[3]));
}

}  // namespace
}  // namespace belvedere
