#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "base/grid.h"

namespace belvedere::tools {

// The bytes of a picture file, encoded sRGB: JPEG where it may be quick, PNG where it must be
// exact.
std::string jpeg_bytes(const Grid<glm::vec3>& picture, int quality = 90);
std::string png_bytes(const Grid<glm::vec3>& picture);

}  // namespace belvedere::tools
