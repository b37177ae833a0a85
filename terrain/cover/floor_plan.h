#pragma once

#include <glm/vec2.hpp>

#include "base/grid.h"
#include "terrain/cover/land_cover.h"
#include "terrain/io/dem.h"

namespace belvedere {

// How the land is laid out, for whoever paints fields and streets. Both grids have the DEM's size.
struct FloorPlan {
  Grid<float> built;  // 0 open land, about .3 a village and the edge of a town … 1 the middle of a large town
  // Which way fields and streets run: along the nearest river or shore, and along the foot of the slopes. (cos 2a, sin 2a) times how
  // sure that is, 0…1; a counterclockwise from east. Twice the angle, because a row that runs east runs west as well.
  Grid<glm::vec2> grain;
};

// Settlements are those of the land cover, wherever it comes from.
FloorPlan plan_floor(const LandCover& land_cover, const Dem& dem);

}  // namespace belvedere
