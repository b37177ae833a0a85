#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "renderer/style/style.h"

namespace belvedere {

// What a picture says of how a style is painted on it. Sizes on the sheet are units of 0.5 mm.
struct StylePaintParameters {
  double pixels_per_unit = 1.0;
  glm::ivec2 sheet_px{0};  // the whole picture, px
  int sky_rows = 0;        // from the sheet's top down to its lowest sky, px; 0: no sky is painted
  std::uint64_t seed = 1;
  double palette = 1.0;        // share of the style's trend and vapour, 0…1
  double brushwork = 1.0;      // share of its strokes, 0…1; 0 leaves the render's own
  double sky = 1.0;            // share of its sky, 0…1
  double scale = 0.0;          // units a pixel of the painting, 0.2…8; 0: the style's own
  double contour_lines = 0.0;  // how dark silhouettes are drawn, 0…1
  double near_m = 8000.0;      // where the trend by distance begins …
  double far_m = 60000.0;      // … and ends: distances along the ray, 0 < near < far
  double form_contrast = 0.0;  // of light and dark of about 14 units, 0.5…2; 0: by the style
  double unevenness = 0.15;    // deviation of contrast from region to region, 0…0.5
  double paint_relief = 0.03;  // light on the ridges of paint, of L, 0…0.1
  double weave = 0.008;        // of the canvas, of L, 0…0.05
};

// Pixels of the sheet to one of the painting.
inline double sheet_px_per_painting_px(const Style& style, const StylePaintParameters& parameters) {
  return (parameters.scale > 0.0 ? parameters.scale : style.units_per_px) *
         parameters.pixels_per_unit;
}

}  // namespace belvedere
