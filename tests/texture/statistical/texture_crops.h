#pragma once

#include <algorithm>
#include <cstdint>

#include "base/random.h"
#include "texture/synthesis/exemplar.h"

// Crops of synthetic paint with known properties.
namespace belvedere::test {

inline std::uint8_t level(double value) {
  return static_cast<std::uint8_t>(std::clamp(value + .5, 0.0, 255.0));
}

// Greens that vary smoothly, wider along the row, with a fleck of yellow here and there.
inline Grid<Rgb8> meadow_crop(int width, int height, std::uint64_t seed = 7) {
  Grid<Rgb8> out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double wide = gaussian_noise(seed, x, y, 6.0, 3.0);
      const double fine = gaussian_noise(seed + 1, x, y, 1.2, .8);
      const double fleck = gaussian_noise(seed + 2, x, y, 1.5) > 1.8 ? 50.0 : 0.0;
      out(x, y) = {level(90.0 + 16.0 * wide + 9.0 * fine + fleck),
                   level(130.0 + 14.0 * wide + 11.0 * fine + fleck), level(60.0 + 8.0 * wide)};
    }
  return out;
}

// Stripes of a period along x.
inline Grid<Rgb8> striped_crop(int width, int height, int period) {
  Grid<Rgb8> out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int shade = (x / (period / 2)) % 2 == 0 ? 200 : 60;
      const auto grain = static_cast<int>(random_index(9, 3, x, y));
      out(x, y) = {level(shade + grain), level(shade + grain), level(shade)};
    }
  return out;
}

}  // namespace belvedere::test
