#pragma once

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "renderer/rock/spurs.h"

namespace belvedere {

// Light and dark bands along the flow of snow and ice, as debris, meltwater and old surfaces draw
// them on glaciers that are too level for any form of their own: about -1 … 1 at each wide pixel of
// `wanted`, 0 elsewhere and off the ice. A pure function of sheet positions and seed; reads
// the wide view within ice_streams_reach.
Grid<float> ice_streams(const SpurGround& ground, PixelRect wanted);
int ice_streams_reach(double pixels_per_unit, int factor);  // wide pixels

}  // namespace belvedere
