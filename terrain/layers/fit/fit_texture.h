#pragma once

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
};

// The texture of each class, from the evenly lit picture less its expected colours. The energy of
// differences of neighbouring blocks of 1, 2 … 16 cells is fitted by octaves of
// noise: the slope of the spectrum by their ratio. Classes with too few cells have none, and none
// has without a picture.
std::vector<ClassTexture> class_textures(const KnownGround& ground, const GroundFit& fit,
                                         const GroundPrediction& prediction);

// The layers of a fit (surface_layers_of) with noise and bumps. Noise makes patches of layers, so
// that the colours of each class vary as strongly as in the picture as far as its layers' colours
// allow; a layer that covers a place entirely keeps it. Each has noise of its own (scale within a
// factor √2 of its class's) and keeps its mean coverage.
SurfaceLayers with_textures(SurfaceLayers layers, const KnownGround& ground, const GroundFit& fit,
                            const std::vector<ClassTexture>& textures);

}  // namespace belvedere
