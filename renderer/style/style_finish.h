#pragma once

#include "renderer/style/style_strokes.h"

namespace belvedere {

// What comes after the strokes: fine detail of the render that they covered (trees, cracks, houses)
// is laid back, light from the upper left falls on the relief of the paint, and the weave of the
// canvas shows through. `ground` is the window's; `canvas` a rectangle of the sheet that reaches
// style_finish_margin_px around `wanted` or to the sheet's edge. Encoded sRGB of `wanted`, which
// lies style_detail_margin_px inside the window.
Grid<glm::vec3> finish_style(const Style& style, const StyleWindow& window,
                             const StyleCanvas& canvas, PixelRect canvas_rect,
                             const StylePaintParameters& parameters, PixelRect wanted);
// Of the canvas, and of the window, around what is wanted.
int style_finish_margin_px(const StylePaintParameters& parameters);
int style_detail_margin_px(const StylePaintParameters& parameters);

}  // namespace belvedere
