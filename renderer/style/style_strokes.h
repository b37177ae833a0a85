#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/pixel_rect.h"
#include "renderer/style/style_ground.h"

namespace belvedere {

// The strokes of a style: placed and coloured as values, then painted by tiles.
//
// They differ from those of texture/strokes, which are sRGB colours sorted by distance, sized for
// trees and houses and without a colour gate at each pixel. These are a hundred times as many,
// blend in OKLab and depend only on the ground.

// Factors of a layer on the brushwork of a class.
struct StyleLayer {
  double length;  // factor on the painting's, like width, spacing, jitter and gate
  double width;
  double alpha;    // 0…1
  double spacing;  // of the distance at which strokes of the fitted size cover the ground twice
  double jitter;   // of the residuals
  double gate;     // of the colour tolerance
  double accents;  // share of strokes with an accent colour, 0…1
};
const std::vector<StyleLayer>& style_layers();

// One stroke. Points are px relative to the top-left corner of its seed's pixel, so that they have
// the same bits in every window.
struct StyleStroke {
  static constexpr int max_points = 9;
  static constexpr int hairs = 8;
  std::uint64_t order = 0;  // hash of its cell: lower is painted first
  glm::ivec2 pixel_px{0};   // pixel of the sheet with its seed
  std::array<glm::vec2, max_points> points{};
  int count = 0;  // of points, at least 2
  float half_width_px = 0.5F;
  float alpha = 0.8F;
  float hair_count = 1.0F;          // across, at most `hairs` - 1
  std::array<float, hairs> hair{};  // amount of paint of each, 0…1
  glm::vec3 colour{0.0F};           // OKLab
  glm::vec3 ground{0.0F};  // colour at the seed; a stroke ends where the ground differs by `gate`
  float gate = 0.075F;
  float depth_m = 0.0F;
  float farther = 0.02F;  // it ends where the ground is farther than depth_m by this share …
  float nearer = 0.02F;   // … or nearer
  LandCoverClass id = LandCoverClass::sky;
};

// Inputs of the strokes in a window whose top-left pixel is `origin_px`.
struct StyleWindow {
  const GuidanceBuffers& guidance;  // depth_m, land_cover, tone
  const StyleGround& ground;
  glm::ivec2 origin_px;
};

// The strokes of a layer whose seeds lie within style_seed_reach_px of a rectangle of the sheet, in
// the order in which they are painted.
std::vector<StyleStroke> place_style_strokes(const Style& style, const StyleWindow& window,
                                             const StylePaintParameters& parameters, int layer,
                                             PixelRect rect);
// Dark strokes along silhouettes, on the nearer side, with the strength `contour_lines`, in
// painting order. Reads depth_m.
std::vector<StyleStroke> place_contour_strokes(const Style& style, const StyleWindow& window,
                                               const StylePaintParameters& parameters,
                                               PixelRect rect);
// Search radius for silhouettes and their directions, px; 0: no contour strokes.
int contour_look_px(const Style& style, const StylePaintParameters& parameters);
// The strokes of all rows of cells in painting order.
std::vector<StyleStroke> in_order(const std::vector<std::vector<StyleStroke>>& rows);
// Max distance, px, between a stroke's seed and what it paints; and between a painted pixel and
// what its strokes read.
int style_seed_reach_px(const Style& style, const StylePaintParameters& parameters);
int style_stroke_margin_px(const Style& style, const StylePaintParameters& parameters);

// Colour in OKLab, and thickness of the paint, 0…1.
struct StyleCanvas {
  Grid<glm::vec3> colour;
  Grid<float> height;
};
// Paints all layers over a rectangle of the sheet, which must lie style_stroke_margin_px inside the
// window or at the sheet's edge.
StyleCanvas paint_style_strokes(const Style& style, const StyleWindow& window,
                                const StylePaintParameters& parameters, PixelRect rect);

}  // namespace belvedere
