#pragma once

#include <array>
#include <cstdint>
#include <cstdlib>

#include "texture/synthesis/synth_plane.h"

namespace belvedere::synth {

// A patch in eight bytes: the grey at eight positions on a ring 1.4 … 2 pixels around its centre.
// Stored with each entry of the pick lists, it shows which of several texels may match the existing
// paint around a pixel without reading their patches.
inline constexpr std::size_t grey_places = 8;

struct Greys {
  std::array<std::uint8_t, grey_places> values{};
  std::array<std::uint8_t, grey_places> counts{};  // 255, or 0 where the position has no class
};

// Grey is (R + 2 G + B) / 4.
inline Greys greys_around(const Plane& plane, std::uint32_t at) {
  const std::ptrdiff_t down = plane.stride;
  const std::array<std::ptrdiff_t, grey_places> steps{-2,        2,        -2 * down, 2 * down,
                                                      -1 - down, 1 - down, -1 + down, 1 + down};
  const std::uint32_t* centre = plane.words.data() + at;
  Greys greys;
  for (std::size_t i = 0; i < grey_places; ++i) {
    const std::uint32_t word = centre[steps[i]];
    greys.values[i] = static_cast<std::uint8_t>(
        ((word & 255U) + 2 * (word >> 8 & 255U) + (word >> 16 & 255U)) >> 2);
    greys.counts[i] = class_of(word) == no_class ? 0 : 255;
  }
  return greys;
}

// Sum of squared differences at the positions that count in `requested`.
inline std::int32_t grey_distance(const Greys& requested, const std::uint8_t* offered) {
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < grey_places; ++i) {
    const std::int32_t off = std::abs(requested.values[i] - offered[i]) & requested.counts[i];
    sum += off * off;
  }
  return sum;
}

}  // namespace belvedere::synth
