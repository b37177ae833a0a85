#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <string>

#include "terrain/cover/land_cover.h"
#include "terrain/layers/surface_layers.h"

namespace belvedere {

// What surface layers add to the form of the ground: bumps of noise (SurfaceLayer::roughness_m) and the beds of lakes. A picture from above
// raises its raster by them (layer_surface); a picture whose pixels lie anywhere asks for a place at a time.

// Of a layer's name, for streams of its own.
std::uint64_t seed_of_name(const std::string& name);
// The noise of bumps of this length, between -1 and 1, and of a layer's own.
LayerNoise bump_noise(double length_m);
std::uint64_t bump_seed(const SurfaceLayer& layer, std::uint64_t seed);

// How the bumps rise at a place of the CRS, a metre east and north: the slope of the sum of share · height · noise, of which a pixel as
// wide as pixel_m (> 0) shows what is longer, so that far ground is smooth. The mean over level ground is 0.
glm::dvec2 bump_slope(const GroundRelief& relief, glm::dvec2 place_m, double pixel_m);

}  // namespace belvedere
