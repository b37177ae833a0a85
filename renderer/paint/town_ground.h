#pragma once

#include <glm/vec3.hpp>

#include "renderer/paint/palette.h"

namespace belvedere {

// The ground between houses: `street` is the colour of the settlement's ramp, with gardens between,
// more in a village than in the centre of a town. `built` 0…1 as in GuidanceBuffers; `drift` is
// AirParameters::hue_drift; where villages are drawn house by house (village_share) the ground is
// paler, so that a place reads as one patch. `light` is the tone that indexes ramps. In winter
// gardens are covered by snow.
glm::vec3 town_ground_colour(const Palette& palette, glm::vec3 street, float built,
                             double altitude_m, double light, float drift, float metres_per_unit);

}  // namespace belvedere
