#include "texture/synthesis/synth_bins.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"

namespace belvedere::synth {

namespace {

constexpr int side = 2 * patch_radius + 1;
constexpr int quantiles = 8;
constexpr std::size_t binned_texels_per_task = 4096;  // texels a task
constexpr std::size_t luminances = 3 * 255 + 1;
constexpr std::size_t contrasts = 384;  // the deviation of values 0…765 is at most 382.5

int luminance(std::uint32_t word) {
  return static_cast<int>((word & 255U) + (word >> 8 & 255U) + (word >> 16 & 255U));
}

// Quantile of each value in a histogram, by the rank of the value's centre.
void to_quantiles(const std::int64_t* histogram, int values, std::uint8_t* quantile) {
  std::int64_t total = 0;
  for (int i = 0; i < values; ++i) total += histogram[i];
  std::int64_t below = 0;
  for (int i = 0; i < values; ++i) {
    const std::int64_t rank =
        (below + histogram[i] / 2) * quantiles / std::max<std::int64_t>(1, total);
    quantile[i] = static_cast<std::uint8_t>(std::min<std::int64_t>(quantiles - 1, rank));
    below += histogram[i];
  }
}

// Deviation of luminance over the texels of the same class in the 7 × 7 around each texel of a row,
// so that a border of classes adds no contrast; the square root of an exact integer, so it is the
// same everywhere.
void contrast_row(const Plane& plane, std::uint32_t row, int width,
                  std::vector<std::uint16_t>& out) {
  const std::size_t columns = static_cast<std::size_t>(width + side - 1);
  std::vector<int> sum(columns);
  std::vector<int> squares(columns);
  std::vector<std::uint32_t> column_class(columns);  // no_class where a column has several
  const std::uint32_t* words = plane.words.data();
  const auto at = [&](std::size_t i, int j) {
    return static_cast<std::size_t>(static_cast<std::int64_t>(row) - patch_radius +
                                    static_cast<std::int64_t>(i) +
                                    static_cast<std::int64_t>(j) * plane.stride);
  };
  for (std::size_t i = 0; i < columns; ++i) {
    column_class[i] = class_of(words[at(i, 0)]);
    for (int j = -patch_radius; j <= patch_radius; ++j) {
      const std::uint32_t word = words[at(i, j)];
      const int value = luminance(word);
      sum[i] += value;
      squares[i] += value * value;
      if (class_of(word) != column_class[i]) column_class[i] = no_class;
    }
  }
  for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
    const std::uint32_t own = class_of(words[row + x]);
    std::int64_t s = 0;
    std::int64_t s2 = 0;
    std::int64_t count = 0;
    for (std::size_t i = x; i < x + side; ++i) {
      if (column_class[i] == own) {
        s += sum[i];
        s2 += squares[i];
        count += side;
        continue;
      }
      for (int j = -patch_radius; j <= patch_radius; ++j) {
        const std::uint32_t word = words[at(i, j)];
        if (class_of(word) != own) continue;
        const int value = luminance(word);
        s += value;
        s2 += value * value;
        ++count;
      }
    }
    const std::int64_t variance = count == 0 ? 0 : (count * s2 - s * s) / (count * count);
    out[x] = static_cast<std::uint16_t>(std::sqrt(static_cast<double>(variance)));
  }
}

}  // namespace

std::vector<std::uint8_t> make_bins(const Plane& exemplars, int classes) {
  const std::size_t class_count = static_cast<std::size_t>(classes);
  std::vector<std::uint16_t> contrast(exemplars.words.size(), 0);
  for (const Plane::Part& part : exemplars.parts) {
    parallel_rows(part.height, [&](int y) {
      const std::uint32_t row = part.origin + static_cast<std::uint32_t>(y) *
                                                  static_cast<std::uint32_t>(exemplars.stride);
      std::vector<std::uint16_t> values(static_cast<std::size_t>(part.width));
      contrast_row(exemplars, row, part.width, values);
      std::copy(values.begin(), values.end(), contrast.begin() + row);
    });
  }
  std::vector<std::int64_t> by_luminance(class_count * luminances, 0);
  std::vector<std::int64_t> by_contrast(class_count * contrasts, 0);
  exemplars.for_each([&](std::uint32_t at) {
    const std::uint32_t c = class_of(exemplars.words[at]);
    if (c == no_class) return;
    ++by_luminance[c * luminances + static_cast<std::size_t>(luminance(exemplars.words[at]))];
    ++by_contrast[c * contrasts + contrast[at]];
  });
  std::vector<std::uint8_t> luminance_quantile(by_luminance.size());
  std::vector<std::uint8_t> contrast_quantile(by_contrast.size());
  for (std::size_t c = 0; c < class_count; ++c) {
    to_quantiles(&by_luminance[c * luminances], luminances, &luminance_quantile[c * luminances]);
    to_quantiles(&by_contrast[c * contrasts], contrasts, &contrast_quantile[c * contrasts]);
  }
  std::vector<std::uint8_t> bins(exemplars.words.size(), 0);
  const int bands =
      static_cast<int>((bins.size() + binned_texels_per_task - 1) / binned_texels_per_task);
  parallel_rows(bands, [&](int b) {
    for (std::size_t at = static_cast<std::size_t>(b) * binned_texels_per_task;
         at < std::min(bins.size(), static_cast<std::size_t>(b + 1) * binned_texels_per_task);
         ++at) {
      const std::uint32_t c = class_of(exemplars.words[at]);
      if (c == no_class) continue;
      const int bright = luminance_quantile[c * luminances + static_cast<std::size_t>(
                                                                 luminance(exemplars.words[at]))];
      bins[at] = static_cast<std::uint8_t>(bright * quantiles +
                                           contrast_quantile[c * contrasts + contrast[at]]);
    }
  });
  return bins;
}

std::vector<std::int32_t> bin_penalties(const std::vector<std::int32_t>& actual,
                                        const std::vector<std::int32_t>& expected,
                                        std::int32_t strength) {
  std::vector<std::int32_t> penalties(actual.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    const std::int64_t excess = (static_cast<std::int64_t>(actual[i]) - expected[i]) * 16 /
                                (static_cast<std::int64_t>(expected[i]) + 4);
    penalties[i] =
        static_cast<std::int32_t>(std::clamp<std::int64_t>(excess, -16, 32) * strength / 16);
  }
  return penalties;
}

std::vector<std::int32_t> steer_bins(const std::vector<std::int32_t>& actual,
                                     const std::vector<std::int32_t>& expected,
                                     std::int32_t strength, std::vector<std::int32_t>& kept) {
  std::vector<std::int32_t> costs = bin_penalties(actual, expected, strength);
  for (std::size_t i = 0; i < costs.size(); ++i) {
    kept[i] = std::clamp(kept[i] + costs[i] / 16, -2 * strength, 2 * strength);
    costs[i] += kept[i];
  }
  return costs;
}

}  // namespace belvedere::synth
