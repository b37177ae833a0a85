#pragma once

#include "renderer/style/style_strokes.h"

namespace belvedere {

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
