#pragma once

#include <cstdint>

#include "base/grid.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// Measures of one picture that the quality figures use (quality.h defines inside a class and at a
// border).

// Squared distance to the nearest pixel on a border of classes (one that differs from its left or
// upper neighbour), at most 255.
Grid<std::uint8_t> border_distance_squared(const Grid<std::uint8_t>& labels);
// The functions below take it as `borders`.
// Mean grey gradient (central differences) inside a class; NaN without inside pixels.
double mean_gradient(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& labels,
                     const Grid<std::uint8_t>& borders, std::uint8_t label);
// Mean length, in pixels, of the run through every third pixel inside a class, along the direction
// in which it is longest: the pixels of a run stay in the class and within `tolerance` (of r + g +
// b) of the pixel. At most 65. NaN without inside pixels.
double stroke_run(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& labels,
                  const Grid<std::uint8_t>& borders, std::uint8_t label, int tolerance);
// The tolerance for an exemplar's class: half its median deviation of r + g + b over 7 × 7 pixels.
int stroke_tolerance(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& labels,
                     std::uint8_t label);
// Share of pixels that differ clearly from the median of their 3 × 3, inside classes and at
// borders.
struct SpeckShares {
  double inside = 0.0;
  double border = 0.0;
};
SpeckShares speck_shares(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& borders);
// Mean over sampled 7 × 7 patches of the root mean squared difference to the most similar patch
// (every second pixel in each direction, every fourth in pictures over 1024 rows) at a distance of
// 16 pixels or more.
double self_distance(const Grid<Rgb8>& picture, int samples);

}  // namespace belvedere
