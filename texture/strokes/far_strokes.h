#pragma once

#include <vector>

#include "texture/strokes/base_picture.h"
#include "texture/strokes/stroke.h"

namespace belvedere {

// Among far ranges a painter lays fewer, broader strokes: planes, not blades of grass. Leaves some of the strokes out and broadens the
// others, by the air before the pixels they grew from; all strokes of one tree have one seed, so that it stands or is missing as a whole.
std::vector<Stroke> broaden_far(std::vector<Stroke> strokes, const BasePicture& base);
// By how much the broadest of them reaches farther then, units.
inline constexpr double far_reach_units = 3.6;

}  // namespace belvedere
