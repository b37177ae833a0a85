#pragma once

#include "renderer/base/grid.h"

namespace belvedere {

// Depth discontinuity 0…1 of each pixel towards its farther 4-neighbours: clamp(14 · log(depth ratio), 0, 1); the nearer side carries
// it. Sky is infinitely far. A plane seen at a grazing angle is no jump: the second difference of log depth decides.
Grid<float> find_silhouettes(const Grid<float>& depth_m);

}  // namespace belvedere
