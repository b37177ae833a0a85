#pragma once

#include "base/grid.h"
#include "base/progress.h"

namespace belvedere {

// Generalization by line integral convolution (Jenny 2021, Terrain generalization with line
// integral convolution, Cartography and Geographic Information Science 48(1)): altitudes are
// averaged along slope lines, which never cross a ridge or a valley, so those stay sharp while the
// slopes between them are smoothed. Defaults as published, lengths in cells of the DEM.
struct LineIntegralParameters {
  float detail_cells = 5.F;  // maximum standard deviation of the first blur, which removes detail;
                             // less on curved ground; 0…20
  float flat_slope_deg =
      6.F;  // flatter ground is smoothed only within itself: the foot of slopes stays sharp; 0…30
  int min_flat_cells = 100;  // smaller flats are treated as slopes
  float length_cells = 5.F;  // half the length of a slope line (as a box; the Gaussian of its
                             // standard deviation is used); 1…20
  int iterations = 5;        // 0…50
  float curvature_weight =
      2.5F;  // protection of convex ground (ridges), times curvature · cell; 0…20
  float curvature_cells = 3.F;   // standard deviation of the curvature's blur; 0…20
  float ridge_sharpness = 0.5F;  // 1: a slope line ends at the ridge; 0: it continues along it,
                                 // which rounds the ridge; 0…1
};

// Cells must be finite. Planes and lakes are unchanged. `mask`: apply_mask (mask.h), empty: none.
// Throws Error(usage) for values out of range.
Grid<float> generalize_along_slope_lines(const Grid<float>& altitude_m, const Grid<float>& mask,
                                         double cell_m, const LineIntegralParameters& parameters,
                                         Progress& progress);

}  // namespace belvedere
