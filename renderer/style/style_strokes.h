#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/pixel_rect.h"
#include "renderer/style/style_ground.h"

namespace belvedere {

// A painting's strokes over a ground, as values: placed and coloured, then painted by tiles.
//
// They are not strokes of texture/strokes: those are colours in sRGB without a gate of colour for
// every pixel, sorted by distance, and sized for trees and houses; these are a hundred times as
// many, blend in OKLab and know only the ground.

// What a layer does with the brushwork of a class.
struct StyleLayer {
  double length;  // of the painting's, as all of these
  double width;
  double alpha;    // 0…1
  double spacing;  // of the distance at which strokes of its own size cover twice
  double jitter;   // of the residuals
  double gate;     // of the tolerance of colour
  double accents;  // share of strokes that take one, 0…1
};
const std::vector<StyleLayer>& style_layers();

// One stroke. Places are px from the middle of its own pixel's top-left corner, so that they have
// the same bits in every window.
struct StyleStroke {
  static constexpr int max_points = 9;
  static constexpr int hairs = 8;
  std::uint64_t order = 0;  // hash of its cell: lower is painted first
  glm::ivec2 pixel_px{0};   // of the sheet, where its seed lies
  std::array<glm::vec2, max_points> points{};
  int count = 0;  // of points, at least 2
  float half_width_px = 0.5F;
  float alpha = 0.8F;
  float hair_count = 1.0F;          // across, at most `hairs` - 1
  std::array<float, hairs> hair{};  // how much paint each gives, 0…1
  glm::vec3 colour{0.0F};           // OKLab
  glm::vec3 ground{0.0F};  // the ground's where it begins: beyond the gate around it it ends
  float gate = 0.075F;
  float depth_m = 0.0F;
  float farther = 0.02F;  // it ends where the ground lies farther than that by this share …
  float nearer = 0.02F;   // … or nearer
  LandCoverClass id = LandCoverClass::sky;
};

// What strokes read of a window whose top-left pixel is `origin_px`.
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
// Dark strokes along silhouettes, on the nearer side, as far as `contour_lines` asks for them; in
// their order. Reads depth_m.
std::vector<StyleStroke> place_contour_strokes(const Style& style, const StyleWindow& window,
                                               const StylePaintParameters& parameters,
                                               PixelRect rect);
// How far a contour stroke looks for a silhouette, and for its direction; 0: there are none.
int contour_look_px(const StylePaintParameters& parameters);
// Strokes of rows of cells, in the order in which they are painted.
std::vector<StyleStroke> in_order(const std::vector<std::vector<StyleStroke>>& rows);
// How far from its seed a stroke paints, and how far it looks from what it paints.
int style_seed_reach_px(const Style& style, const StylePaintParameters& parameters);
int style_stroke_margin_px(const Style& style, const StylePaintParameters& parameters);

// OKLab, and how high the paint stands, 0…1.
struct StyleCanvas {
  Grid<glm::vec3> colour;
  Grid<float> height;
};
// All layers over a rectangle of the sheet, which must lie style_stroke_margin_px inside the window
// or at the sheet's edge.
StyleCanvas paint_style_strokes(const Style& style, const StyleWindow& window,
                                const StylePaintParameters& parameters, PixelRect rect);

}  // namespace belvedere
