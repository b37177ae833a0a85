#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "texture/strokes/base_picture.h"
#include "texture/strokes/stroke.h"

namespace belvedere {

// Painters lay fewer, broader strokes on far ranges: planes, not blades of grass. Leaves out some
// strokes and broadens the others, by the air in front of their first pixels. All strokes of one
// tree start at one pixel, so it is kept or left out as a whole; the choice depends on the position
// on the sheet, so that prints of all sizes, and all windows, leave out the same. `origin_px`:
// position of the base picture's (0,0) on the sheet.
std::vector<Stroke> broaden_far(std::vector<Stroke> strokes, const BasePicture& base,
                                glm::ivec2 origin_px, double pixels_per_unit);
// How much farther the broadest of them then reaches, units.
inline constexpr double far_reach_units = 3.6;

}  // namespace belvedere
