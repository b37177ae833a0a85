#pragma once

#include <glm/vec3.hpp>

#include "renderer/paint/palette.h"

namespace belvedere {

// The ground that houses stand on: `street` is the colour of the settlement's ramp, gardens lie between, more in a village than in the
// middle of a town. `built` 0…1 as in GuidanceBuffers; `drift` is AirParameters::hue_drift; `light` the tone that indexes ramps.
// In winter gardens lie under snow.
glm::vec3 town_ground_colour(const Palette& palette, glm::vec3 street, float built, double altitude_m, double light, float drift);

}  // namespace belvedere
