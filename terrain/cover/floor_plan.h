#pragma once

#include <glm/vec2.hpp>

#include "base/grid.h"
#include "terrain/cover/land_cover.h"
#include "terrain/io/dem.h"

namespace belvedere {

// Layout of the valley floor, for painting fields and streets. Both grids have the DEM's size.
struct FloorPlan {
  Grid<float> built;  // 0 open land, about .3 a village or the edge of a town … 1 the centre of a
                      // large town
  // Direction of fields and streets: along the nearest river or shore, and along the foot of the
  // slopes. (cos 2a, sin 2a) times the confidence, 0…1; a counterclockwise from east. The angle is
  // doubled because a row that runs east also runs west.
  Grid<glm::vec2> grain;
};

// Settlements are those of the land cover, from any source.
FloorPlan plan_floor(const LandCover& land_cover, const Dem& dem);

}  // namespace belvedere
