#pragma once

#include "base/run.h"
#include "renderer/world/world.h"
#include "texture/strokes/ice/ice_plan.h"

namespace belvedere {

// The flow of ice on the sheet of a world, from one trace of the whole sheet at about one pixel per
// unit (0.5 mm) and one ray per pixel. The same for every part of the sheet and for every reduced
// view of it. Not traced if the land cover has no ice.
IcePlan make_ice_plan(const World& world, const Run& run);

}  // namespace belvedere
