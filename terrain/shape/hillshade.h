#pragma once

#include <cstdint>

#include "base/grid.h"

namespace belvedere {

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
