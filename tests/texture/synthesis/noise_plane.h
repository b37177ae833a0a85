#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/random.h"
#include "texture/synthesis/synth_plane.h"

// Planes of random values, for tests of the parts of synthesis.
namespace belvedere::synth::test {

constexpr int classes = 3;

// A plane of noise with blotches of classes and smooth guides; `seed` selects the picture.
inline Plane noise_plane(std::vector<std::pair<int, int>> sizes, int guides, std::uint64_t seed,
                         bool with_holes, int margin = padding) {
  Plane plane = make_plane(sizes, guides, margin);
  for (std::size_t p = 0; p < plane.parts.size(); ++p)
    for (int y = 0; y < plane.parts[p].height; ++y)
      for (int x = 0; x < plane.parts[p].width; ++x) {
        const std::uint32_t at = plane.index(static_cast<int>(p), x, y);
        std::uint32_t c = random_index(classes, seed, x / 5, y / 4, p);
        if (with_holes && random_index(20, seed + 1, x / 2, y / 2, p) == 0) c = no_class;
        plane.words[at] =
            static_cast<std::uint32_t>(random_bits(seed + 2, x, y, p) & 0xffffffU) | c << 24;
        for (int g = 0; g < guides; ++g)
          plane.guides[at * static_cast<std::size_t>(guides) + static_cast<std::size_t>(g)] =
              static_cast<std::uint8_t>(
                  random_index(256, seed + 3, x / 3, y / 3, static_cast<std::uint64_t>(g)));
      }
  pad(plane);
  return plane;
}

}  // namespace belvedere::synth::test
