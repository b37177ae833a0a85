#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "base/filter.h"
#include "base/grid.h"
#include "base/math_exact.h"
#include "base/random.h"
#include "terrain/layers/fit/picture_sun.h"

namespace belvedere::synthetic {

// Reproducible hills: blurred noise, some 30° steep at most with cells of 30 m.
inline Grid<float> hills(int width, int height, std::uint64_t seed = 5, double height_m = 6000.0) {
  Grid<float> noise(width, height);
  for (int y = 0; y != height; ++y)
    for (int x = 0; x != width; ++x)
      noise(x, y) = static_cast<float>(height_m * random_normal(seed, x, y));
  return gaussian_blur(noise, 8.0);
}

struct Picture {
  Grid<glm::vec3> rgb;
  std::vector<std::uint8_t> classes;
};
// Seven classes in bands of smooth noise and of altitude, in the colours of a summer landscape, lit
// by a sun, with noise of `noise` of 255.
inline Picture seven_classes(const Grid<float>& altitude_m, const PictureSun& sun, double noise) {
  constexpr std::array<std::array<double, 3>, 7> colours = {{{44, 82, 38},
                                                             {96, 124, 52},
                                                             {150, 138, 70},
                                                             {142, 104, 72},
                                                             {118, 116, 114},
                                                             {70, 128, 150},
                                                             {204, 206, 210}}};
  const int width = altitude_m.width();
  const int height = altitude_m.height();
  const Grid<float> patches = hills(width, height, 77, 1.0);
  const Grid<float> light = sunlight(altitude_m, 30.0, sun);
  Picture picture{Grid<glm::vec3>(width, height), std::vector<std::uint8_t>(altitude_m.size())};
  // Classes by rank of a mixture of altitude and patches, in different shares.
  std::vector<float> key(altitude_m.size());
  for (std::size_t i = 0; i != key.size(); ++i) key[i] = altitude_m[i] / 6000.0F + patches[i];
  std::vector<float> sorted = key;
  std::sort(sorted.begin(), sorted.end());
  constexpr std::array<double, 7> until = {0.22, 0.42, 0.58, 0.72, 0.85, 0.92, 1.0};
  for (std::size_t i = 0; i != key.size(); ++i) {
    const double rank = static_cast<double>(std::lower_bound(sorted.begin(), sorted.end(), key[i]) -
                                            sorted.begin()) /
                        static_cast<double>(key.size());
    std::uint8_t k = 0;
    while (rank >= until[k] && k != 6) ++k;
    picture.classes[i] = k;
    const double shade = 0.35 + 0.75 * static_cast<double>(light[i]);
    for (std::size_t c = 0; c != 3; ++c) {
      const double n =
          noise * random_normal(99, static_cast<std::int64_t>(i), static_cast<std::int64_t>(c));
      picture.rgb[i][static_cast<int>(c)] =
          static_cast<float>(std::clamp(colours[k][c] * shade + n, 0.0, 255.0));
    }
  }
  return picture;
}

}  // namespace belvedere::synthetic
