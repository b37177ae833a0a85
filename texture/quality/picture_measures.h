#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

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

// Visibility of seams: pixels side by side that were not side by side in a painting. Each step (|R
// − R'| + |G − G'| + |B − B'|) / 3 is compared with the steps between neighbours of the same two
// classes in the source paintings (the mean of the two paintings' means). If neither has these
// classes side by side: the step of random texels of the two classes, times the ratio of actual to
// random steps at the paintings' other borders; this does not detect a painting of another tone,
// because no reference shows how the classes would meet. 1: seams step as neighbours in the
// painting do.
struct SeamVisibility {
  std::size_t pairs =
      0;  // of 4-neighbours, except across silhouettes, where the ground itself steps
  std::size_t compared = 0;  // those with a reference in the paintings
  double step = 0.0;         // mean over pairs, levels of 255
  double visibility = 0.0;   // sum of steps / sum of the paintings' own, over compared pairs; 0:
                             // none, or paintings without any step
};
struct SeamsOfKinds {
  SeamVisibility within;   // both pixels from one painting
  SeamVisibility between;  // from different paintings
};

// Seams inside paintings and between them. Matches must be inside the exemplars; depth_m may be
// empty: no silhouettes.
SeamsOfKinds seam_visibility(const MatchField& matches, const std::vector<Exemplar>& exemplars,
                             const Grid<float>& depth_m, float depth_ratio);

}  // namespace belvedere
