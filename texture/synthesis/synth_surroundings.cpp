#include "texture/synthesis/synth_surroundings.h"

#include <algorithm>

#include "base/parallel.h"

namespace belvedere::synth {

std::vector<Surroundings> make_surroundings(const Plane& plane, int radius, int classes) {
  std::vector<Surroundings> out(plane.words.size());
  for (std::size_t p = 0; p < plane.parts.size(); ++p) {
    const Plane::Part& part = plane.parts[p];
    const int height = part.height;
    const int width = part.width;
    // Counts by column slide down, counts of the window slide along the row: each pixel costs 2 columns of as many classes as there are.
    constexpr int band = 64;
    parallel_rows((height + band - 1) / band, [&](int b) {
      const std::size_t kinds = static_cast<std::size_t>(classes);
      std::vector<std::uint16_t> columns(static_cast<std::size_t>(width) * kinds, 0);
      const auto add_row = [&](int y, int sign) {
        if (y < 0 || y >= height) return;
        const std::uint32_t row = plane.index(static_cast<int>(p), 0, y);
        for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
          const std::uint32_t c = class_of(plane.words[row + x]);
          if (c != no_class) columns[x * kinds + c] = static_cast<std::uint16_t>(columns[x * kinds + c] + sign);
        }
      };
      for (int y = b * band - radius; y < b * band + radius; ++y) add_row(y, 1);
      std::vector<std::int32_t> window(kinds);
      for (int y = b * band; y < std::min(height, (b + 1) * band); ++y) {
        add_row(y + radius, 1);
        std::fill(window.begin(), window.end(), 0);
        std::int32_t total = 0;
        const auto add_column = [&](int x, int sign) {
          if (x < 0 || x >= width) return;
          for (std::size_t c = 0; c < kinds; ++c) {
            const std::int32_t count = sign * columns[static_cast<std::size_t>(x) * kinds + c];
            window[c] += count;
            total += count;
          }
        };
        for (int x = -radius; x < radius; ++x) add_column(x, 1);
        for (int x = 0; x < width; ++x) {
          add_column(x + radius, 1);
          const std::uint32_t at = plane.index(static_cast<int>(p), x, y);
          const std::uint32_t own = class_of(plane.words[at]);
          if (own != no_class && window[own] < total) {
            std::uint32_t commonest = own == 0 ? 1U : 0U;
            for (std::uint32_t c = 0; c < kinds; ++c) {
              if (c != own && window[c] > window[commonest]) commonest = c;
            }
            out[at] = {static_cast<std::uint8_t>(255 * (total - window[own]) / total), static_cast<std::uint8_t>(commonest)};
          }
          add_column(x - radius, -1);
        }
        add_row(y - radius, -1);
      }
    });
  }
  return out;
}

}  // namespace belvedere::synth
