#pragma once

#include "base/pixel_rect.h"
#include "renderer/style/style_ground.h"
#include "renderer/style/style_strokes.h"

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

// Finishes the painted canvas: adds part of the render's fine detail that strokes covered (trees,
// cracks, houses), shades the relief of the paint with light from the upper left, and adds the
// weave of the canvas. `canvas_rect` is the rectangle of the sheet that `canvas` covers; it reaches
// style_finish_margin_px around `wanted` or to the sheet's edge. Returns encoded sRGB of `wanted`,
// which lies style_detail_margin_px inside the window.
Grid<glm::vec3> finish_style(const Style& style, const StyleWindow& window,
                             const StyleCanvas& canvas, PixelRect canvas_rect,
                             const StylePaintParameters& parameters, PixelRect wanted);
// Margins around `wanted`: of the canvas, and of the window.
int style_finish_margin_px(const StylePaintParameters& parameters);
int style_detail_margin_px(const StylePaintParameters& parameters);

}  // namespace belvedere
