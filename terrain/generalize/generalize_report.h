#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// Measures of the effect of generalization on a terrain, independent of the method. Altitudes in
// metres, every cell finite, before and after of one size. Slices are equal steps of the foreground
// share (u_d of equation 5), the nearest first: slice k of n holds shares from 1 - k/n down to 1 -
// (k+1)/n. An empty share is all foreground.

// The slice of each cell.
Grid<std::uint8_t> distance_slices(const Grid<float>& foreground_share, glm::ivec2 size,
                                   int slices);

// Mean square of each Laplacian band, m², [slice][band], coarsest band first as for weights. Coarse
// bands are assigned to slices by the share's Gaussian pyramid. 0 if a slice has no cells of that
// band.
std::vector<std::vector<double>> band_energy(const Grid<float>& altitude_m,
                                             const Grid<float>& foreground_share, int bands,
                                             int slices);

struct AltitudeChange {
  std::size_t cells = 0;
  double mean_m = 0.0;     // of after - before
  double rms_m = 0.0;      // of the same, about 0
  double largest_m = 0.0;  // the largest amount, ≥ 0
};
// [slice].
std::vector<AltitudeChange> altitude_change(const Grid<float>& before_m, const Grid<float>& after_m,
                                            const Grid<std::uint8_t>& slice_of, int slices);

// Curvature across the crest, 1/m: how strongly the ground is convex in the direction in which it
// is most convex (the smallest second derivative of the Evans–Young quadric, sign reversed). In
// contrast to plan curvature it needs no slope along the crest. Negative in bowls.
Grid<float> crest_curvature(const Grid<float>& altitude_m, glm::dvec2 cell_m);
// 1 on ridge lines: cells in which the ground, smoothed by one cell, has its maximum across the
// crest (Steger 1998), the sharpest quarter of them. Cells on the border are 0.
Grid<std::uint8_t> ridge_lines(const Grid<float>& altitude_m, glm::dvec2 cell_m);

// Curvature along the ridge lines of the original terrain, and the part that is kept. The reference
// is a plain blur: the Gaussian whose bands have as much energy as the result's, summed over the
// bands that lost energy.
struct RidgeSharpness {
  std::size_t cells = 0;      // ridge-line cells of the slice
  double before_per_m = 0.0;  // mean crest curvature
  double after_per_m = 0.0;
  double gaussian_per_m = 0.0;
  // Standard deviation of that Gaussian, cells. 0: no band lost energy. At most the widest one
  // tried (widest_gaussian_cells).
  double gaussian_cells = 0.0;
  double kept() const { return before_per_m > 0.0 ? after_per_m / before_per_m : 0.0; }
  double kept_by_gaussian() const {
    return before_per_m > 0.0 ? gaussian_per_m / before_per_m : 0.0;
  }
};
constexpr double widest_gaussian_cells = 16.0;
// [slice].
std::vector<RidgeSharpness> ridge_sharpness(const Grid<float>& before_m, const Grid<float>& after_m,
                                            glm::dvec2 cell_m, const Grid<float>& foreground_share,
                                            int bands, int slices);

// Where slopes meet flat ground: cells that slope_foot_mask() keeps to more than half.
Grid<std::uint8_t> slope_feet(const Grid<float>& altitude_m, glm::dvec2 cell_m, int bands);

// Hollows of a whole terrain, filled to their outlets, and the part of them at the foot of slopes,
// where masks act.
struct Pits {
  std::size_t count = 0;    // pieces of hollows deeper than 0.5 m
  double hollows_m3 = 0.0;  // volume of water that all hollows would hold
  double deepest_m = 0.0;   // of all
  std::size_t at_feet = 0;  // pieces whose deepest cell is at the foot of a slope
  double at_feet_m3 = 0.0;  // volume in such cells
  double lowered_m3 = 0.0;  // ground removed in such cells, with an outlet or not
  std::size_t elsewhere() const { return count - at_feet; }
  double elsewhere_m3() const { return hollows_m3 - at_feet_m3; }
};
Pits find_pits(const Grid<float>& before_m, const Grid<float>& after_m,
               const Grid<std::uint8_t>& feet, glm::dvec2 cell_m);

}  // namespace belvedere
