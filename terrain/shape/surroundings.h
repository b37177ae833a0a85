#pragma once

#include "base/grid.h"
#include "terrain/io/dem.h"

namespace belvedere {

// A window of a larger terrain with the ground around it, for quantities with a long reach:
// shadows, wide means.
struct Surrounded {
  Grid<float> altitude_m;
  GeoTransform transform;
  int left = 0, top = 0;  // the window's first cell
};

// `own`: altitudes of the window's cells, or of blocks of them, at `transform`. Around them, up to
// `reach_m` if available, lies the whole's ground, interpolated bilinearly.
Surrounded surround(const Grid<float>& own, const GeoTransform& transform, const Dem& whole,
                    double reach_m);

}  // namespace belvedere
