#pragma once

#include <vector>

#include "terrain/layers/fit/fit_texture.h"
#include "terrain/layers/fit/ground_fit.h"
#include "terrain/layers/surface_layers.h"

namespace belvedere {

// The layers of a fit (surface_layers_of) with noise and bumps. Noise makes patches of layers, so
// that the colours of each class vary as strongly as in the picture as far as its layers' colours
// allow; a layer that covers a place entirely keeps it. Each has noise of its own (scale within a
// factor √2 of its class's) and keeps its mean coverage. Colours of a class are means of many
// cells: they are then moved apart, about their own mean and within the picture's range, by what
// mixing still lacks.
SurfaceLayers with_textures(SurfaceLayers layers, const KnownGround& ground, const GroundFit& fit,
                            const std::vector<ClassTexture>& textures);

}  // namespace belvedere
