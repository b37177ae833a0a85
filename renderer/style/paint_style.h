#pragma once

#include "base/pixel_rect.h"
#include "renderer/style/style_ground.h"

namespace belvedere {

// A finished picture in a painter's style, in two steps, so that what strokes read around them is
// made once: the ground and the direction of strokes; then strokes and all that lies on them.

// Brings the colours of a window near the style, and finds how its strokes run. Of the pixels
// `wanted` of the window. The guidance has depth_m, land_cover, fall_line and, for vapour,
// valley_height_m; `render` is encoded sRGB, `veil` the share of mist before each pixel (empty:
// there is none).
StyleGround prepare_style(const Style& style, const GuidanceBuffers& guidance,
                          const Grid<glm::vec3>& render, const Grid<float>& veil,
                          const StylePaintParameters& parameters, glm::ivec2 origin_px,
                          PixelRect wanted);
int style_preparation_margin_px(const Style& style, const StylePaintParameters& parameters);

// Strokes, detail, relief and weave. Encoded sRGB of `wanted` of the window. The guidance has
// depth_m, land_cover and tone.
Grid<glm::vec3> lay_style(const Style& style, const GuidanceBuffers& guidance,
                          const StyleGround& ground, const StylePaintParameters& parameters,
                          glm::ivec2 origin_px, PixelRect wanted);
int style_laying_margin_px(const Style& style, const StylePaintParameters& parameters);

// Both. `render` is encoded sRGB, and so is the result, of the size of `wanted`; `veil` the share
// of mist before each pixel, empty where there is none.
Grid<glm::vec3> paint_style(const Style& style, const GuidanceBuffers& guidance,
                            const Grid<glm::vec3>& render, const Grid<float>& veil,
                            const StylePaintParameters& parameters, glm::ivec2 origin_px,
                            PixelRect wanted);
int style_margin_px(const Style& style, const StylePaintParameters& parameters);

}  // namespace belvedere
