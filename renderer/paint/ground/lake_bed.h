#pragma once

#include <glm/vec3.hpp>

#include "renderer/paint/ground/ground_tint.h"
#include "renderer/paint/palette.h"
#include "renderer/trace/water/water_ground.h"

namespace belvedere {

// What is seen of a lake's bed through the water: near the shore the bed in the ground's own colours, then pale water, then the palette's.
struct LakeBed {
  float depth_m = 0.F;  // 0: nothing is seen of it
  TintShift tint;       // of debris, which is what a bed is painted as
  float share = 0.F;    // how far water goes over to what is seen through it, 0…1

  // Over water of a colour (encoded sRGB) at a light.
  glm::vec3 under(glm::vec3 water, const Palette& palette, double altitude_m, double light) const;
};

// Painted water (encoded sRGB) over no bed at all: as much greener, and half as much lighter, as pictures from above have it.
glm::vec3 shallow_water(glm::vec3 water);

// Where the tint knows no bed: made up from the banks, in the palette's colours. Depths are painted some times larger than they are where a
// unit of the sheet shows many metres, so that shallows keep a width there.
LakeBed lake_bed(const Palette& palette, const WaterGround::Place& water, float metres_per_unit);
// At a place of the scene's CRS that is water, of which a pixel shows `footprint_m`. In winter lakes are dark.
LakeBed lake_bed(const GroundTint& tint, const Palette& palette, double altitude_m, glm::dvec3 place_m, double footprint_m);

}  // namespace belvedere
