#pragma once

#include "terrain/io/dem.h"
#include "terrain/shape/hydrology.h"

namespace belvedere {

// A DEM knows a lake's surface alone. Beds made up from its shape: a bowl that falls off from the shore and is deepest where the shore is
// farthest.
struct LakeBedParameters {
  LakeParameters lakes;
  double shore_slope = 0.16;  // metres a metre, where the water begins; > 0
  double deepest_m = 150.0;   // no lake is deeper; > 0
};

// Depth of the water at each cell, m; 0 on land. A lake whose farthest place from the shore is d away gets D = min(deepest, slope · d / 2)
// of depth there, and D (1 - (1 - t)²) at t times as far.
Grid<float> lake_depth_m(const Dem& dem, const LakeBedParameters& parameters = {});

}  // namespace belvedere
