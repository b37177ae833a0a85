#pragma once

#include "base/grid.h"

namespace belvedere {

// Ground metres per output pixel, which vary slowly: sampled every few cells of the DEM, linear
// between.
struct PixelGround {
  Grid<float> m_per_pixel;  // cell (i, j) is the DEM's (step_cells i, step_cells j); constant
                            // beyond. Empty: every band prints
  int step_cells = 1;       // ≥ 1
};

}  // namespace belvedere
