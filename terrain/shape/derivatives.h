#pragma once

#include <cstdint>

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

struct HillshadeParameters {
  float azimuth_deg = 315.F;  // direction of the light, clockwise from north; 0…360
  float altitude_deg = 45.F;  // above the horizon; 0…90
  float exaggeration = 1.F;   // of the altitudes; > 0
};

// Hillshade as by gdaldem: 1 + 254 cos of the angle between normal (Horn 1981) and light, 1 where
// the ground faces away; 0 where the altitude or one of its neighbours is void (NaN). Borders are
// replicated.
Grid<std::uint8_t> hillshade(const Grid<float>& altitude_m, double cell_x_m, double cell_y_m,
                             const HillshadeParameters& parameters);

}  // namespace belvedere
