#pragma once

#include "terrain/io/dem.h"
#include "terrain/shape/hydrology.h"

namespace belvedere {

// A DEM contains only a lake's surface. Synthetic beds from its shape: a bowl that deepens from the
// shore and is deepest where the shore is farthest.
struct LakeBedParameters {
  LakeParameters lakes;
  double shore_slope = 0.16;  // rise over run at the shore; > 0
  double deepest_m = 150.0;   // maximum depth; > 0
};

// Depth of the water at each cell, m; 0 on land. A lake whose farthest position from the shore is
// at distance d has the depth D = min(deepest, slope · d / 2) there, and D (1 - (1 - t)²) at the
// distance t d.
Grid<float> lake_depth_m(const Dem& dem, const LakeBedParameters& parameters = {});

}  // namespace belvedere
