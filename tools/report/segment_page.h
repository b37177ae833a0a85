#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <string>

#include "base/grid.h"
#include "renderer/exemplar/painting_segments.h"

namespace belvedere::tools {

// A self-contained page without network access: the painting with the borders of its groups,
// `groups` of them at first, which clicks and keys merge, split and name; undo; the mask as a file
// that `[[exemplar]]` reads. Throws Error(output).
void write_segment_page(const std::string& path, const std::string& title,
                        const std::string& mask_name, const Grid<glm::vec3>& picture,
                        const PaintingSegments& segments, std::size_t groups);

}  // namespace belvedere::tools
