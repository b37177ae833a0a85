#include "base/lines/power_line.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/math_exact.h"
#include "base/random.h"

namespace belvedere {
namespace {

std::uint32_t bits_of(float value) { return std::bit_cast<std::uint32_t>(value); }

void expect_the_same(const std::vector<float>& bases, double exponent) {
  std::vector<float> out(bases.size() + 1, -7.0F);
  power_line(bases.data(), exponent, static_cast<int>(bases.size()), out.data());
  for (std::size_t i = 0; i < bases.size(); ++i)
    ASSERT_EQ(bits_of(out[i]),
              bits_of(static_cast<float>(exact::pow(static_cast<double>(bases[i]), exponent))))
        << bases[i] << " ^ " << exponent;
  EXPECT_EQ(out.back(), -7.0F);
}

TEST(PowerLine, IsExactPowToTheBit) {
  for (const double exponent : {0.6, 0.41, -1.7, 0.0, 1.0, 3.25}) {
    std::vector<float> bases;
    // Floats of all sizes, then values like catchments, and values near the borders of the
    // logarithm's halves.
    for (int i = 0; i < 20000; ++i)
      bases.push_back(static_cast<float>(exact::exp2(240.0 * random_uniform(3, i, 0) - 120.0)));
    for (int i = 0; i < 20000; ++i)
      bases.push_back(static_cast<float>(50.0 * random_uniform(4, i, 0)));
    for (const float centre : {0.70710678F, 1.0F, 1.41421356F, 2.0F})
      for (int i = -40; i <= 40; ++i)
        bases.push_back(std::bit_cast<float>(bits_of(centre) + static_cast<std::uint32_t>(i)));
    expect_the_same(bases, exponent);
  }
}

TEST(PowerLine, HasRestsAndOddNumbersToo) {
  for (std::size_t count = 0; count < 20; ++count)
    expect_the_same(std::vector<float>(count, 3.7F), 0.6);
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float odd : {0.0F, -2.0F, infinity, 1e-42F, std::numeric_limits<float>::max(),
                          std::numeric_limits<float>::min()})
    for (std::size_t at = 0; at < 8; ++at) {
      std::vector<float> bases(8, 1.3F);
      bases[at] = odd;
      expect_the_same(bases, 0.6);
      expect_the_same(bases, -30.0);
    }
}

}  // namespace
}  // namespace belvedere
