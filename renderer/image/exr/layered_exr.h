#pragma once

#include <string>

#include "renderer/image/layers/layered_sheet.h"

namespace belvedere {

// A multi-part OpenEXR file in scene-linear light with primaries of sRGB: "panorama" (R, G, B: the
// composite), then a part with R, G, B, A, premultiplied, for each layer from the bottom up; hidden
// layers have the attribute "hidden".
//
// Paint is blended in encoded sRGB, but compositors blend in linear light. So a layer's opacity is
// unchanged, and its colour is chosen so that the composite up to it is correct: if F is the linear
// composite below and T the required one with this layer, its premultiplied colour is T - (1 - a)
// F, of values already rounded to halves, so that only the last rounding remains. Where paint is
// darker than its ground and half covers it, that is slightly negative, which half floats allow.
// Hidden layers have their own colours.
void write_layered_exr(const std::string& path, const LayeredSheet& sheet, Progress& progress);

}  // namespace belvedere
