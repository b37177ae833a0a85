#pragma once

#include <glm/vec3.hpp>

#include "renderer/paint/ground/ground_tint.h"
#include "renderer/paint/palette.h"
#include "renderer/trace/water/water_ground.h"

namespace belvedere {

// A lake's bed seen through the water: near the shore the bed in the ground's own colours, then
// pale water, then the palette's colour.
struct LakeBed {
  float depth_m = 0.F;  // 0: the bed is not visible
  TintShift tint;       // of debris, the class that a bed is painted as
  float share = 0.F;    // how far water takes the colour of what is seen through it, 0…1

  // Applied to a colour of water (encoded sRGB) at a light.
  glm::vec3 under(glm::vec3 water, const Palette& palette, double altitude_m, double light) const;
};

// Painted water (encoded sRGB) without a visible bed: greener by as much as orthophotos show, and
// lighter by half as much.
glm::vec3 shallow_water(glm::vec3 water);

// Where the tint has no bed: inferred from the banks, in the palette's colours. Where a unit of the
// sheet covers many metres, depths are painted smaller than they are, so that shallows keep a
// visible width.
LakeBed lake_bed(const Palette& palette, const WaterGround::Place& water, float metres_per_unit);
// At a water position in the scene's CRS where a pixel covers `footprint_m`. In winter lakes are
// dark.
LakeBed lake_bed(const GroundTint& tint, const Palette& palette, double altitude_m,
                 glm::dvec3 position_m, double footprint_m);

}  // namespace belvedere
