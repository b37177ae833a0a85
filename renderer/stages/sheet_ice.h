#pragma once

#include "base/run.h"
#include "renderer/world/world.h"
#include "texture/strokes/ice_plan.h"

namespace belvedere {

// How ice runs on the sheet of a world, from one look at the whole of it at about a pixel a unit (0.5 mm) and a ray a pixel. It is the same
// for every part of the sheet and for every reduced view of it. Without a look where the land cover knows no ice.
IcePlan make_ice_plan(const World& world, const Run& run);

}  // namespace belvedere
