#pragma once

#include <glm/vec3.hpp>

#include "base/grid.h"

namespace belvedere {

// Scene-linear RGB with sRGB (Rec. 709) primaries; 1 is diffuse white.
using Image = Grid<glm::vec3>;

}  // namespace belvedere
