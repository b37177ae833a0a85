#pragma once

#include "base/grid.h"
#include "terrain/cover/floor_plan.h"
#include "terrain/cover/land_cover.h"
#include "terrain/io/dem.h"
#include "terrain/shape/catchments.h"

namespace belvedere {

// Values from the wide surroundings of each position, which take longest to compute for a terrain
// model; fields as there (terrain_model.h). They depend only on elevation and land cover, not on
// the view, so they can be reused between pictures.
struct GroundSurroundings {
  Grid<float> valley_height_m;
  Grid<float> rim_m;
  Grid<float> flow;
  FloorPlan floor_plan;
};

// `catchments`: as for make_terrain_model.
GroundSurroundings find_surroundings(const Dem& dem, const LandCover& land_cover,
                                     Catchments* catchments = nullptr);

}  // namespace belvedere
