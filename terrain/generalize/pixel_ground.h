#pragma once

#include "base/grid.h"

namespace belvedere {

// Ground metres that an output pixel shows, which change slowly: known at every so many cells of the DEM, linear between them.
struct PixelGround {
  Grid<float> m_per_pixel;  // cell (i, j) is the DEM's (step_cells i, step_cells j); the last ones hold on beyond. Empty: every band prints
  int step_cells = 1;       // ≥ 1
};

}  // namespace belvedere
