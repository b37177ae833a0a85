#pragma once

#include "base/grid.h"
#include "terrain/cover/floor_plan.h"
#include "terrain/cover/land_cover.h"
#include "terrain/io/dem.h"
#include "terrain/shape/catchments.h"

namespace belvedere {

// What a place's wide surroundings say of it, and takes longest to find of a terrain model: fields as there (terrain_model.h). It hangs on
// elevation and land cover alone, not on the view, so it can be kept from one picture to the next.
struct GroundSurroundings {
  Grid<float> valley_height_m;
  Grid<float> rim_m;
  Grid<float> flow;
  FloorPlan floor_plan;
};

// `catchments`: as for make_terrain_model.
GroundSurroundings find_surroundings(const Dem& dem, const LandCover& land_cover, Catchments* catchments = nullptr);

}  // namespace belvedere
