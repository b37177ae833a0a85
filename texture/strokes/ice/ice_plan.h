#pragma once

#include <vector>

#include "base/guidance_buffers.h"
#include "texture/strokes/base_picture.h"
#include "texture/strokes/ice/ice_flow.h"
#include "texture/strokes/ice/ice_way.h"

namespace belvedere {

// The ice on a whole sheet, which no window of it can determine. In units of the sheet, so that one
// plan serves every size.
struct IcePlan {
  IceFlow flow;
  std::vector<IceWay> ways;
};

// From a picture of the whole sheet; about one pixel per unit is sufficient. Needs depth, position,
// land cover, fall line, slope, footprint and relief_s. It uses the parameters pixels_per_unit (of
// this picture) and seed.
IcePlan plan_ice(const GuidanceBuffers& guidance, const StrokeParameters& parameters);

}  // namespace belvedere
