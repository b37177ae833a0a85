#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/grid.h"

namespace belvedere {

// A picture (encoded sRGB) reduced to a size no larger than its own, in OKLab: the colour of the
// mean of the pixels that each result pixel touches.
Grid<glm::vec3> reduced_oklab(const Grid<glm::vec3>& picture, glm::ivec2 size);

}  // namespace belvedere
