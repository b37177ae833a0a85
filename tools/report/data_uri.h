#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "base/grid.h"

namespace belvedere::tools {

// For self-contained pages: a picture of encoded RGB, 0…1, as a data URI:
// "data:image/png;base64,…".
std::string png_address(const Grid<glm::vec3>& picture);

}  // namespace belvedere::tools
