#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "base/grid.h"
#include "renderer/style/style.h"

namespace belvedere::tools {

// Writes the result of `style fit` as a page with pictures, in a folder that can be moved and read
// offline: the painting and its classes, the colours of each class compared with the reference's
// and its strokes with the painting's, sky, air, what was derived and from what. Throws
// Error(output).
void write_style_page(const std::string& folder, const std::string& painting_name,
                      const Grid<glm::vec3>& painting, const Grid<std::uint8_t>& mask,
                      const Style& style, const Palette& reference, const std::string& command);

}  // namespace belvedere::tools
