#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/grid.h"

namespace belvedere {

// The direction strokes run in, of a painting of which only picture (encoded sRGB) and labels are known, as the fall line of guidance:
// unit, x right, y down, never upwards; 0 where strokes lie (within 15° of the horizontal), as on flat ground, or run in no direction. From
// the structure tensor of lightness over about three strokes' widths; borders of labels have no part in it.
Grid<glm::vec2> find_stroke_direction(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& labels, double stroke_px);

}  // namespace belvedere
