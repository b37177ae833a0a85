#pragma once

#include <cstdint>

#include "base/grid.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// Measures of one picture, of which figures of quality are made (see quality.h for what is inside a class and at a border).

// Squared distance to the nearest pixel on a border of classes (one that differs from its left or upper neighbour), at most 255.
Grid<std::uint8_t> border_distance_squared(const Grid<std::uint8_t>& labels);
// The parts below take it as `borders`.
// Mean grey gradient (central differences) inside a class; NaN where there is no inside.
double mean_gradient(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& labels, const Grid<std::uint8_t>& borders, std::uint8_t label);
// Mean length, in pixels, of the run through every third pixel inside a class, along the direction in which it is longest: the pixels of
// a run stay in the class and within `tolerance` (of r + g + b) of the pixel. At most 65. NaN where there is no inside.
double stroke_run(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& labels, const Grid<std::uint8_t>& borders, std::uint8_t label,
                  int tolerance);
// The tolerance that goes with an exemplar's class: half its median deviation of r + g + b over 7 × 7 pixels.
int stroke_tolerance(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& labels, std::uint8_t label);
// Share of pixels that stand out from the median of their 3 × 3, inside classes and at borders.
struct SpeckShares {
  double inside = 0.0;
  double border = 0.0;
};
SpeckShares speck_shares(const Grid<Rgb8>& picture, const Grid<std::uint8_t>& borders);
// Mean over sampled 7 × 7 patches of the root mean squared difference to the most alike patch (every second pixel each way, every
// fourth in pictures over 1024 rows) that lies 16 pixels or more away.
double self_distance(const Grid<Rgb8>& picture, int samples);

}  // namespace belvedere
