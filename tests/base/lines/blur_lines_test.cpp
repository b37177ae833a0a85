#include "base/lines/blur_lines.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

#include "base/random.h"

namespace belvedere {
namespace {

// Numbers whose sums round, so that a different order of additions is visible.
std::vector<float> numbers(int count) {
  std::vector<float> out;
  for (int i = 0; i < count; ++i)
    out.push_back(static_cast<float>(1234.5 * random_uniform(9, i, 0)));
  return out;
}

constexpr float untouched = -7.0F;

// Each loop is compared with its definition, to the bit, also for lengths that are not a multiple
// of any vector width, and nothing beyond the requested range is written.
class BlurLines : public testing::TestWithParam<int> {};  // numbers an element has

TEST_P(BlurLines, ConvolvesInTheStatedOrder) {
  const int step = GetParam();
  for (const int radius : {0, 1, 5, 32}) {
    const std::vector<float> kernel = numbers(radius + 1);
    for (const int elements : {1, 2, 7, 16, 67, 131}) {
      const int count = elements * step;
      const std::vector<float> line = numbers(count + 2 * radius * step);
      const float* centre = line.data() + static_cast<std::ptrdiff_t>(radius) * step;
      std::vector<float> out(static_cast<std::size_t>(count) + 1, untouched);
      blur_lines::convolve(centre, count, step, kernel.data(), radius, out.data());
      for (int j = 0; j < count; ++j) {
        float sum = kernel[0] * centre[j];
        for (int k = 1; k <= radius; ++k)
          sum +=
              kernel[static_cast<std::size_t>(k)] * (centre[j - k * step] + centre[j + k * step]);
        ASSERT_EQ(out[static_cast<std::size_t>(j)], sum) << radius << ' ' << elements << ' ' << j;
      }
      EXPECT_EQ(out.back(), untouched);
    }
  }
}

TEST_P(BlurLines, HalvesAndRefinesByTheirWeights) {
  const auto step = static_cast<std::size_t>(GetParam());
  for (const std::size_t elements : {1U, 2U, 7U, 16U, 67U, 131U}) {
    const std::vector<float> a = numbers(static_cast<int>((2 * elements + 3) * step));
    std::vector<float> out(elements * step + 1, untouched);
    blur_lines::halve(a.data(), static_cast<int>(elements), GetParam(), out.data());
    for (std::size_t j = 0; j < elements; ++j)
      for (std::size_t l = 0; l < step; ++l) {
        const auto at = [&](std::size_t k) { return a[(2 * j + k) * step + l]; };
        ASSERT_EQ(out[j * step + l],
                  0.375F * at(2) + 0.25F * (at(1) + at(3)) + 0.0625F * (at(0) + at(4)))
            << elements << ' ' << j;
      }
    EXPECT_EQ(out.back(), untouched);

    const std::vector<float> halved = numbers(static_cast<int>((elements / 2 + 3) * step));
    blur_lines::refine(halved.data(), static_cast<int>(elements), GetParam(), out.data());
    for (std::size_t i = 0; i < elements; ++i)
      for (std::size_t l = 0; l < step; ++l) {
        const auto at = [&](std::size_t k) { return halved[(i / 2 + k) * step + l]; };
        ASSERT_EQ(out[i * step + l],
                  i % 2 == 0 ? 0.75F * at(1) + 0.125F * (at(0) + at(2)) : 0.5F * (at(1) + at(2)))
            << elements << ' ' << i;
      }
    EXPECT_EQ(out.back(), untouched);
  }
}

INSTANTIATE_TEST_SUITE_P(Steps, BlurLines, testing::Values(1, 3, 16));

}  // namespace
}  // namespace belvedere
