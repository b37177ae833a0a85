#pragma once

#include "base/grid.h"

namespace belvedere {

// Depth discontinuity 0…1 of each pixel towards its four neighbours: clamp(14 · log(depth ratio),
// 0, 1), so that 7 % is a full silhouette; the nearer side carries it. Depth in metres along the
// ray, +inf is sky; against the sky it is 1. Only the part of the log ratio that no smooth surface
// explains counts. In perspective the *inverse* depth of a plane is linear in the picture at any
// angle, so each side's inverse depth is extrapolated linearly to the other, and the larger of the
// two predicted steps is subtracted: a second difference. A plane, a crease or the edge of a
// plateau is not a silhouette.
Grid<float> find_silhouettes(const Grid<float>& depth_m);

}  // namespace belvedere
