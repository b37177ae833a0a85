#pragma once

#include "base/grid.h"

namespace belvedere {

// Depth discontinuity 0…1 of each pixel towards its four neighbours: clamp(14 · log(depth ratio), 0, 1), so that 7 % is a full
// silhouette; the nearer side carries it. Depth in metres along the ray, +inf is sky; against the sky it is 1.
// Of the log ratio only what no smooth surface explains counts. Seen in perspective the *inverse* depth of a plane is linear in
// the picture, however grazing the view, so each side's inverse depth is continued by a line to the other and the larger of
// the two steps so foretold is taken off: a second difference. A plane, a crease or the edge of a plateau is no silhouette.
Grid<float> find_silhouettes(const Grid<float>& depth_m);

}  // namespace belvedere
