#pragma once

#include "base/pixel_rect.h"
#include "renderer/style/style_ground.h"

namespace belvedere {

// Renders a finished picture in a style, in two steps: the ground and the stroke directions, then
// the strokes and the finish. Strokes read the first result around them, so it is computed once.

// Computes ground colours and stroke directions for the pixels `wanted` of a window. The guidance
// needs depth_m, land_cover, fall_line and, for vapour, valley_height_m. `render` is encoded sRGB;
// `veil` is the share of mist in front of each pixel (empty: none).
StyleGround prepare_style(const Style& style, const GuidanceBuffers& guidance,
                          const Grid<glm::vec3>& render, const Grid<float>& veil,
                          const StylePaintParameters& parameters, glm::ivec2 origin_px,
                          PixelRect wanted);
int style_preparation_margin_px(const Style& style, const StylePaintParameters& parameters);

// Adds strokes, detail, relief and weave. Returns encoded sRGB of the pixels `wanted` of the
// window. The guidance needs depth_m, land_cover and tone.
Grid<glm::vec3> lay_style(const Style& style, const GuidanceBuffers& guidance,
                          const StyleGround& ground, const StylePaintParameters& parameters,
                          glm::ivec2 origin_px, PixelRect wanted);
int style_laying_margin_px(const Style& style, const StylePaintParameters& parameters);

// Both steps. The result is encoded sRGB of the size of `wanted`.
Grid<glm::vec3> paint_style(const Style& style, const GuidanceBuffers& guidance,
                            const Grid<glm::vec3>& render, const Grid<float>& veil,
                            const StylePaintParameters& parameters, glm::ivec2 origin_px,
                            PixelRect wanted);
int style_margin_px(const Style& style, const StylePaintParameters& parameters);

}  // namespace belvedere
