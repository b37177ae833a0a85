#pragma once

#include <glm/vec3.hpp>

namespace belvedere {

// The colour of deep water far from the shore; sRGB as encoded, in the unit of the ground's colour.
struct WaterColours {
  glm::vec3 shallow{128.F, 178.F, 172.F};
  glm::vec3 deep{34.F, 78.F, 112.F};
};

// The colour of water of this depth (metres) over ground of this colour (sRGB as encoded, 0…255).
// The bed disappears within some metres; pale water turns deep.
glm::vec3 water_colour(const glm::vec3& ground, float depth_m, const WaterColours& water = {});

}  // namespace belvedere
