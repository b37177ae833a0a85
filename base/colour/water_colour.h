#pragma once

#include <glm/vec3.hpp>

namespace belvedere {

// What water looks like over no bed at all, and far from any; sRGB as encoded, in the units of the ground's.
struct WaterColours {
  glm::vec3 shallow{128.F, 178.F, 172.F};
  glm::vec3 deep{34.F, 78.F, 112.F};
};

// Water over ground of a colour (sRGB as encoded, 0…255), of this depth in metres: the bed is lost within some metres, pale water turns
// deep.
glm::vec3 water_colour(const glm::vec3& ground, float depth_m, const WaterColours& water = {});

}  // namespace belvedere
