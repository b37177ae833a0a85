#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "renderer/style/style.h"

namespace belvedere {

struct BrushworkParameters {
  std::size_t min_texels = 600;  // of a class
  std::size_t samples = 5'000;   // measured positions of a class
  int residuals = 64;            // of each third of lightness
  int accents = 16;
  // Limits: a small class gives strokes as long as the class, which look like hairs when rendered.
  double max_length_px = 20.0;
  double max_width_px = 5.0;
  double accent_share = 0.05;   // of texels: the most colourful
  double max_deviations = 2.2;  // of a residual
};

// Fits the brushwork of each class of the (clean) mask, including sky (recipe B1). Direction comes
// from the structure tensor of lightness (sigma 0.8 and 3 px). Length and width are three times the
// lags along and across it at which the autocorrelation of locally normalized lightness has fallen
// to one half; for opaque strokes at random positions these are the true length and width.
// Residuals are the colours of strokes minus the mean within 1.2 lengths. `colours` is OKLab.
std::array<StyleBrushwork, land_cover_class_count> fit_brushwork(
    const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
    const BrushworkParameters& parameters = {});

}  // namespace belvedere
