#pragma once

#include <array>
#include <vector>

#include "terrain/layers/fit/ground_fit.h"
#include "terrain/layers/surface_layers.h"

namespace belvedere {

// Variation of a class's colour at lengths of a few cells that the inputs do not explain: what
// noise and bumps of a fitted file continue beyond the picture's resolution.
struct ClassTexture {
  LayerNoise noise;       // scale, octaves and gain of its spectrum
  double strength = 0.0;  // lightness (mean of the channels, 0…255) per unit of this noise; 0: none
  double roughness_m =
      0.0;  // ± height of bumps as long as a cell, from the part that light explains
  double deviation = 0.0;  // standard deviation of the evenly lit lightness, 0…255
  std::array<std::array<double, 2>, 3> range{};  // 2nd and 98th percentile of red, green, blue
};

// The texture of each class, from the evenly lit picture less its expected colours. The energy of
// differences of neighbouring blocks of 1, 2 … 16 cells is fitted by octaves of
// noise: the slope of the spectrum by their ratio. Classes with too few cells have none, and none
// has without a picture.
std::vector<ClassTexture> class_textures(const KnownGround& ground, const GroundFit& fit,
                                         const GroundPrediction& prediction);

// Weights of the octaves of layer noise: gain^i, times 2 over their sum.
std::vector<double> octave_weights(int octaves, double gain);

}  // namespace belvedere
