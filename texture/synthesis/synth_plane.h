#pragma once

#include <cstdint>
#include <vector>

#include "base/grid.h"

namespace belvedere::synth {

// In synthesis a pixel is one word, R | G << 8 | B << 16 | class << 24, so that one vector
// operation compares colour and class of several pixels. Classes are dense numbers 0, 1, 2 … in the
// order of their labels; no_class is 255.
inline constexpr std::uint32_t no_class = 255;
inline constexpr int padding =
    4;  // words around each picture; a patch of radius 3 read 8 words wide stays inside
inline constexpr int patch_radius = 3;  // patches are 7 × 7 by default …
inline constexpr int largest_patch_radius =
    5;  // … up to 11 × 11, read 16 words wide, which need wide_padding
inline constexpr int wide_padding = 6;
constexpr int padding_for(int radius) { return radius > patch_radius ? wide_padding : padding; }

constexpr std::uint32_t class_of(std::uint32_t word) { return word >> 24; }

// One or more pictures in one block of memory, stacked with a common stride and surrounded by
// padding without class. A position is one index into `words`; so a match is 4 bytes, a step to a
// neighbour one addition in any picture, and a step out of a picture reaches a pixel without class.
// Index order is (picture, y, x). The exemplars of a level are one plane, the target another.
struct Plane {
  struct Part {
    int width = 0;
    int height = 0;
    std::uint32_t origin = 0;  // index of pixel (0, 0)
  };
  struct Place {
    int part = 0;
    int x = 0;
    int y = 0;
  };

  int stride = 0;
  int margin = padding;  // words of padding around each picture
  std::vector<Part> parts;
  int guide_count = 0;
  std::vector<std::uint32_t> words;
  std::vector<std::uint8_t> guides;  // guide_count per word
  // Silhouettes of exemplars: cut::right and cut::down per word, where one lies between a texel and
  // its neighbour; empty: none.
  std::vector<std::uint8_t> cuts;
  // Where some pictures lack guides: by part × guide_count + guide 255, or 0 where the part lacks
  // it (eight may be read from the last part's first); and by part × 256 + class the constant price
  // of what it lacks. Both empty: none lacks any.
  std::vector<std::uint8_t> known;
  std::vector<std::int64_t> lacking_price;

  bool knows(int part, std::size_t guide) const {
    return known.empty() ||
           known[static_cast<std::size_t>(part) * static_cast<std::size_t>(guide_count) + guide] !=
               0;
  }
  // The picture that contains an index; padding belongs to the one above.
  int part_of(std::uint32_t index) const {
    int part = static_cast<int>(parts.size()) - 1;
    while (part > 0 && index < parts[static_cast<std::size_t>(part)].origin) --part;
    return part;
  }
  std::uint32_t index(int part, int x, int y) const {
    const Part& p = parts[static_cast<std::size_t>(part)];
    return p.origin + static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(stride) +
           static_cast<std::uint32_t>(x);
  }
  // The inverse of index for pixels inside a picture.
  Place position(std::uint32_t index) const;
  const std::uint8_t* guides_at(std::uint32_t index) const {
    return guides.data() + static_cast<std::size_t>(index) * static_cast<std::size_t>(guide_count);
  }
  // An index in the padding whose eight neighbours are padding too: the match of an unmatched
  // pixel.
  std::uint32_t nowhere() const { return static_cast<std::uint32_t>(2 * stride + 2); }
  // Calls f(index) for every pixel inside the pictures, in index order.
  template <class F>
  void for_each(F&& f) const {
    for (const Part& part : parts) {
      for (int y = 0; y < part.height; ++y) {
        const std::uint32_t row =
            part.origin + static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(stride);
        for (int x = 0; x < part.width; ++x) f(row + static_cast<std::uint32_t>(x));
      }
    }
  }
};

// Silhouettes between a texel and the next one.
namespace cut {
inline constexpr std::uint8_t right = 1, down = 2;
}  // namespace cut

// A plane of empty pictures of these sizes (width, height), without classes. Throws Error(limit)
// over 2^31 words.
Plane make_plane(const std::vector<std::pair<int, int>>& sizes, int guide_count,
                 int margin = padding);
// Fills the padding with the nearest pixel's colour and no class.
void pad(Plane& plane);
// The next coarser level, sides (n + 1) / 2: colour and guides low-passed by [1 3 3 1]² / 64 over
// pixels of a class, class by the majority of the 2 × 2 children, ties to the lower one. Two texels
// are cut if both lines of children that lead from the first of one to the first of the other are.
// Padded.
Plane halve(const Plane& fine);

// Silhouettes, one byte per word of a plane with a single part: which of the 4 neighbours belong to
// the same surface.
namespace link {
inline constexpr std::uint8_t right = 1, left = 2, down = 4, up = 8, all = 15;
inline constexpr std::uint8_t cut_patch = 128;  // the patch around contains a missing link
}  // namespace link

// Cuts of one picture of a plane, in their words: neighbours whose depths differ by more than
// `ratio` (1.04: 4 %), and the sky (+inf) from all else. Returns whether there are any.
bool add_cuts(const Grid<float>& depth_m, int part, float ratio, Plane& plane);

// Depths of the coarser level: that of the first child with the coarse pixel's class (values of
// different surfaces never mix).
Grid<float> halve_depth(const Grid<float>& depth_m, const Plane& fine, const Plane& coarse);
// Neighbours whose depths differ by more than `ratio` (1.04: 4 %) are not linked, nor is sky (+inf)
// with anything but sky. `radius` is that of the patches that missing links cut.
std::vector<std::uint8_t> make_links(const Grid<float>& depth_m, const Plane& plane, float ratio,
                                     int radius = patch_radius);
// Whether a step by (dx, dy), each -1 … 1, stays on the surface; diagonals may pass either corner.
bool linked(const std::uint8_t* links, int stride, std::uint32_t from, int dx, int dy);

}  // namespace belvedere::synth
