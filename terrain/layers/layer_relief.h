#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>

#include "terrain/cover/land_cover.h"
#include "terrain/layers/surface_layers.h"

namespace belvedere {

// Relief that surface layers add to the ground: bumps of noise (SurfaceLayer::roughness_m) and lake
// beds. A picture from above raises its raster by them (layer_surface); a picture with arbitrary
// pixel positions queries single positions.

// Hash of a layer's name, for streams of its own.
std::uint64_t seed_of_name(const std::string& name);
// The noise of bumps of this length, between -1 and 1, individual for each layer.
LayerNoise bump_noise(double length_m);
std::uint64_t bump_seed(const SurfaceLayer& layer, std::uint64_t seed);

// Slope of the bumps at a position of the CRS, per metre east and north: the gradient of the sum of
// share · height · noise. Only parts longer than pixel_m (> 0) are included, so that far ground is
// smooth. The mean over level ground is 0.
glm::dvec2 bump_slope(const GroundRelief& relief, glm::dvec2 position_m, double pixel_m);

}  // namespace belvedere
