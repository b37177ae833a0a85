#pragma once

#include <string>

#include "renderer/image/layers/layered_sheet.h"

namespace belvedere {

// A multi-part OpenEXR file in scene-linear light with primaries of sRGB: "panorama" (R, G, B: what the layers make), then a part with R,
// G, B, A, multiplied, for each layer from the bottom up; parts that are hidden elsewhere have the attribute "hidden".
//
// Paint is mixed in encoded sRGB, compositors mix in linear light. So a layer's opacity stays what it is, and its colour becomes what makes
// the layers up to it come out right: if F is what those below make in linear light and T what they shall make with this one, its
// multiplied colour is T - (1 - a) F, of values already rounded to halves, so that only the last rounding is left. Where paint is darker
// than its ground and half covers it, that is a little below 0, as half floats may be. Hidden layers have their own colours.
void write_layered_exr(const std::string& path, const LayeredSheet& sheet, Progress& progress);

}  // namespace belvedere
