#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "renderer/style/style.h"

namespace belvedere {

// Parameters of painting a picture in a style. Sizes on the sheet are units of 0.5 mm.
struct StylePaintParameters {
  double pixels_per_unit = 1.0;
  glm::ivec2 sheet_px{0};  // the whole picture, px
  int sky_rows = 0;        // from the sheet's top down to its lowest sky, px; 0: no sky is painted
  std::uint64_t seed = 1;
  double palette = 1.0;        // share of the style's trend and vapour, 0…1
  double brushwork = 1.0;      // share of its strokes, 0…1; 0: no strokes
  double sky = 1.0;            // share of its sky, 0…1
  double scale = 0.0;          // units per pixel of the painting, 0.2…8; 0: the style's
  double contour_lines = 1.0;  // share of its dark lines on silhouettes, 0…1
  double near_m = 8000.0;      // start of the trend with distance …
  double far_m = 60000.0;      // … and its end: distances along the ray, 0 < near < far
  double form_contrast = 0.0;  // factor on forms of about 14 units, 0.5…2; 0: from the style
  double unevenness = 1.0;     // share of the style's regional variation of contrast, 0…1
  double paint_relief = 0.03;  // shading of the paint's relief, in L, 0…0.1
  double weave = 0.008;        // of the canvas, in L, 0…0.05
};

// Pixels of the sheet per pixel of the painting.
inline double sheet_px_per_painting_px(const Style& style, const StylePaintParameters& parameters) {
  return (parameters.scale > 0.0 ? parameters.scale : style.units_per_px) *
         parameters.pixels_per_unit;
}

// Strength of dark lines on silhouettes, 0…1.
inline double contour_strength(const Style& style, const StylePaintParameters& parameters) {
  return style.contour_lines * parameters.contour_lines;
}

// Deviation of log2 of contrast between regions that is missing in the program's pictures.
double missing_unevenness(const Style& style, const StylePaintParameters& parameters);

// Sigma of these regions, units.
inline constexpr double style_region_units = 110.0;

}  // namespace belvedere
