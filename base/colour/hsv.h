#pragma once

#include <glm/vec3.hpp>

namespace belvedere {

// Hue, saturation and value (Smith 1978): hue in turns, 0…1, 0 if it has none; saturation 0…1;
// value in the unit of the channels.
glm::dvec3 to_hsv(glm::dvec3 rgb);
glm::dvec3 from_hsv(glm::dvec3 hsv);

}  // namespace belvedere
