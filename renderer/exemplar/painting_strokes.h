#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/grid.h"

namespace belvedere {

// The direction of strokes in a painting of which only picture (encoded sRGB) and labels are known,
// as the fall line of guidance: unit, x right, y down, never upwards; 0 where strokes are
// horizontal (within 15°), as on flat ground, or have no direction. From the structure tensor of
// lightness over about three stroke widths; borders of labels are excluded.
Grid<glm::vec2> find_stroke_direction(const Grid<glm::vec3>& picture,
                                      const Grid<std::uint8_t>& labels, double stroke_px);

}  // namespace belvedere
