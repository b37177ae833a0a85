#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec3.hpp>

#include "renderer/style/fit/style_painting.h"

namespace belvedere {

// Figures that distinguish painters (recipe A9), as in Style.
struct PaintFigures {
  double broken = 0.0;
  double vapour = 0.0;
  double form_deviation = 0.0;
  double unevenness = 0.0;
  double contour_lines = 0.0;
  glm::dvec3 trend{0.0};
};
PaintFigures measure_paint(const StylePainting& painting);

// Standard deviation, over windows of 32 × 32 pixels, of log2 of the contrast in them (of
// structures finer than 4 px; contrast counts from one in a thousand): how unevenly paint is worked
// out. Of windows with at least 80 % ground (not 0); 0 if these are fewer than four.
double measure_unevenness(const Grid<float>& lightness, const Grid<std::uint8_t>& ground);

// Medium-scale forms: lightness between sigma 2 and 12 px.
Grid<float> middle_forms(const StylePainting& painting);

bool is_ground_label(std::uint8_t label);

// Standard deviation over pixels with `wanted(x, y)`; 0 if there are none.
template <class F>
double deviation_where(const Grid<float>& values, F wanted) {
  double count = 0.0;
  double sum = 0.0;
  double squares = 0.0;
  for (int y = 0; y < values.height(); ++y)
    for (int x = 0; x < values.width(); ++x) {
      if (!wanted(x, y)) continue;
      const double v = static_cast<double>(values(x, y));
      count += 1.0;
      sum += v;
      squares += v * v;
    }
  if (count == 0.0) return 0.0;
  return std::sqrt(std::max(0.0, squares / count - sum / count * (sum / count)));
}

}  // namespace belvedere
