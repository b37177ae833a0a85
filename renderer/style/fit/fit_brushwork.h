#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "renderer/style/style.h"

namespace belvedere {

struct BrushworkParameters {
  std::size_t min_texels = 600;  // of a class
  std::size_t samples = 5'000;   // places of a class that are measured
  int residuals = 64;            // of each third of lightness
  int accents = 16;
  // A small class gives lengths of its own size, which are hairs in the picture.
  double max_length_px = 20.0;
  double max_width_px = 5.0;
  double accent_share = 0.05;   // the most colourful
  double max_deviations = 2.2;  // of a residual
};

// How the painter lays the strokes of each class of the (clean) mask, sky too (recipe B1).
// Direction by the structure tensor of lightness (sigma 0.8 and 3 px); length and width are three
// times the distance along and across it at which the correlation of locally normalized lightness
// has fallen to one half, which for opaque strokes thrown at random is their length and width;
// residuals are what strokes differ by from the mean within 1.2 lengths. `colours` is OKLab.
std::array<StyleBrushwork, land_cover_class_count> fit_brushwork(
    const Grid<glm::vec3>& colours, const Grid<std::uint8_t>& mask,
    const BrushworkParameters& parameters = {});

}  // namespace belvedere
