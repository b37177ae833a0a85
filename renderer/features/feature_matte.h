#pragma once

#include <cstdint>

#include "base/guidance_buffers.h"
#include "renderer/features/drawn_features.h"

namespace belvedere {

// Which kinds of features cover each pixel of a rectangle of the sheet, and how much of it: ids
// count the kinds of the style from 1. What lies on top hides what lies below it; trees in front of
// a line are not considered. Each pixel depends only on its position on the sheet. depth_m, of the
// rectangle: distance from the eye; `crest_rows` as in FeatureGround.
Grid<MattePixel> make_feature_matte(const DrawnFeatures& features, const Grid<float>& depth_m,
                                    PixelRect rect, const Grid<std::int16_t>* crest_rows = nullptr);

}  // namespace belvedere
