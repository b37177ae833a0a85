#pragma once

#include <glm/vec2.hpp>

#include "base/guidance_buffers.h"
#include "renderer/style/style.h"

namespace belvedere {

// The render in the style's colours, before strokes; OKLab.
struct StyleGround {
  Grid<glm::vec3> colour;    // with all detail; visible between strokes
  Grid<glm::vec3> smoothed;  // bilateral filter of it, from which strokes take their colours
  Grid<glm::vec2> along;     // unit direction of strokes in the image (x right, y down), up to sign
};

// Computes all but `along`: applies the style's trend with distance, its vapour, its sky and the
// contrast of medium-scale forms, then a bilateral filter. `render` is encoded sRGB; `veil` is the
// share of mist in front of each pixel (empty: none), by which the render's sky is kept. Reads
// depth_m, land_cover and valley_height_m. Exact from style_ground_margin_px inside those edges of
// the window that are not the sheet's.
StyleGround make_style_ground(const Style& style, const GuidanceBuffers& guidance,
                              const Grid<glm::vec3>& render, const Grid<float>& veil,
                              const StylePaintParameters& parameters, glm::ivec2 origin_px);
int style_ground_margin_px(const Style& style, const StylePaintParameters& parameters);

// Position of a distance between near_m (0) and far_m (1) on a logarithmic scale, clamped.
double style_distance(const StylePaintParameters& parameters, double depth_m);

// The painting's sky: a smoothed grid of its colours plus its two principal components of colour,
// as noise with the painting's correlation lengths and distribution. Everything is a function of
// the position on the sheet.

// Blends it, in OKLab, into the sky pixels of a window whose top-left pixel is `origin_px`.
void paint_style_sky(Grid<glm::vec3>& lab, const Style& style, const GuidanceBuffers& guidance,
                     const StylePaintParameters& parameters, glm::ivec2 origin_px);

// Maps a normal deviate to the amount of a change by its quantiles (at shares .02 … .98): linear
// between them, constant beyond.
double shaped_amount(const StyleSkyChange& change, double normal);

}  // namespace belvedere
