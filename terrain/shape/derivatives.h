#pragma once

#include "base/grid.h"

namespace belvedere {

// Derivatives of an elevation grid: altitudes and cells in metres, rows north to south, every cell
// finite. Neighbours outside the grid are the nearest cells inside.

// Slope by Horn (1981), as gdaldem computes it, 0…90 degrees.
Grid<float> slope_deg(const Grid<float>& altitude_m, double cell_x_m, double cell_y_m);
// The same where it lies between two bounds; flatter ground gets 0, steeper 90.
struct SlopeBounds {
  double low_deg = 0.0;
  double high_deg = 90.0;
};
Grid<float> slope_deg(const Grid<float>& altitude_m, double cell_x_m, double cell_y_m,
                      const SlopeBounds& bounds);

// Height above the Gaussian mean, m: blur(inner_m) - blur(outer_m), both standard deviations; 0 for
// inner_m means the cell itself.
Grid<float> relief(const Grid<float>& altitude_m, double cell_m, double inner_m, double outer_m);
// Height above the lowest ground (smoothed by one cell) within ±radius_m along x and y, m, ≥ 0.
Grid<float> height_above_valley(const Grid<float>& altitude_m, double cell_m, double radius_m);

}  // namespace belvedere
