#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "base/grid.h"

namespace belvedere::tools {

// For pages that need no file beside them: a picture of encoded RGB, 0…1, as an address that holds it: "data:image/png;base64,…". It passes
// through a file in the folder named, which is gone afterwards.
std::string png_address(const Grid<glm::vec3>& picture, const std::string& scratch_folder);

}  // namespace belvedere::tools
