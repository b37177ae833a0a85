#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "texture/strokes/base_picture.h"
#include "texture/strokes/stroke.h"

namespace belvedere {

// Among far ranges a painter lays fewer, broader strokes: planes, not blades of grass. Leaves some of the strokes out and broadens the
// others, by the air before the pixels they grew from. All strokes of one tree grew from one pixel, so that it stands or is missing as a
// whole; which ones are missing hangs on their place on the sheet, so that prints of all sizes, and all windows, miss the same.
// `origin_px`: where the base picture's (0,0) lies on the sheet.
std::vector<Stroke> broaden_far(std::vector<Stroke> strokes, const BasePicture& base, glm::ivec2 origin_px, double pixels_per_unit);
// By how much the broadest of them reaches farther then, units.
inline constexpr double far_reach_units = 3.6;

}  // namespace belvedere
