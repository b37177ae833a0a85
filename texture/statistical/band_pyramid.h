#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/grid.h"
#include "texture/statistical/clique_model.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// Flags of a pixel in a band picture.
inline constexpr std::uint8_t pixel_counts = 1;   // part of the texture: its cliques are counted
inline constexpr std::uint8_t pixel_changes = 2;  // may be changed
inline constexpr std::uint8_t pixel_free = pixel_counts | pixel_changes;

// A picture in the bands of a model, at one level of a pyramid.
struct BandPicture {
  std::array<Grid<float>, 3> bands;
  Grid<std::uint8_t> states;

  BandPicture() = default;
  BandPicture(int width, int height)
      : bands{Grid<float>(width, height), Grid<float>(width, height), Grid<float>(width, height)},
        states(width, height, pixel_free) {}
  int width() const { return states.width(); }
  int height() const { return states.height(); }
  const Grid<float>& band(int b) const { return bands[static_cast<std::size_t>(b)]; }
  Grid<float>& band(int b) { return bands[static_cast<std::size_t>(b)]; }
};
// Level 0 is the picture itself.
using BandPyramid = std::vector<BandPicture>;

// The principal axes of a crop's colours where `states` (empty: everywhere) counts them, in
// descending order of variance, each oriented towards light; ranges too.
BandSpace find_bands(const Grid<Rgb8>& crop, const Grid<std::uint8_t>& states);

// To bands, with noise of half a level added first so that histograms have no gaps; and back,
// rounded.
BandPicture to_bands(const Grid<Rgb8>& picture, const BandSpace& bands,
                     const Grid<std::uint8_t>& states);
Grid<Rgb8> to_picture(const BandPicture& picture, const BandSpace& bands);

// The next coarser picture into `coarse`: the mean by binomial weights 1 3 3 1 of the pixels that
// count, zero where none does. A box filter would leave visible blocks. `states` of the coarse one
// stay unchanged; coarse_states makes them: a pixel counts if .4 of its weight does, and may change
// if any of the four that it covers may.
void halve(const BandPicture& fine, BandPicture& coarse);
Grid<std::uint8_t> coarse_states(const Grid<std::uint8_t>& fine);
BandPyramid make_pyramid(BandPicture finest, int levels);

// Value of a coarse grid at pixel (x, y) of the next finer one, bilinear.
float enlarged(const Grid<float>& coarse, int x, int y);

}  // namespace belvedere
