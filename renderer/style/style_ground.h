#pragma once

#include <glm/vec2.hpp>

#include "base/guidance_buffers.h"
#include "renderer/style/style_parameters.h"

namespace belvedere {

// The render brought near a style before any stroke lies on it, in OKLab.
struct StyleGround {
  Grid<glm::vec3> colour;  // with all detail: what shines through between strokes
  Grid<glm::vec3> calm;    // flattened within edges: what strokes take their colours from
  Grid<glm::vec2> along;   // unit direction of strokes in the image (x right, y down), up to sign
};

// Everything but `along`: the style's trend with distance and its vapour, its sky, contrast of
// middle forms, then a bilateral filter. `render` is encoded sRGB; `veil` the share of mist before
// each pixel (empty: none), through which the render's sky is kept. Reads depth_m, land_cover and
// valley_height_m. Right beyond style_ground_margin_px from the window's edges that are not the
// sheet's.
StyleGround make_style_ground(const Style& style, const GuidanceBuffers& guidance,
                              const Grid<glm::vec3>& render, const Grid<float>& veil,
                              const StylePaintParameters& parameters, glm::ivec2 origin_px);
int style_ground_margin_px(const Style& style, const StylePaintParameters& parameters);

// How far a place has gone from near_m to far_m, 0…1, by the logarithm of its distance.
double style_distance(const StylePaintParameters& parameters, double depth_m);

}  // namespace belvedere
