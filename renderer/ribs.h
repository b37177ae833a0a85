#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "renderer/base/grid.h"
#include "renderer/base/guidance_buffers.h"

namespace belvedere {

// Ribs and gullies down the fall line, which give rock its form: image noise, smeared along the fall line (line integral convolution,
// Cabral & Leedom 1993), taken as a relief and lit from one side. look/recipe.md, section Tone.
struct RibParameters {
  double pixels_per_unit = 1.0;  // a unit is 0.5 mm of the sheet
  double sun_side = 1.0;         // > 0: flanks that face right are lit, < 0: those that face left
  std::uint64_t seed = 1;
};

// Noise of `sigma_units`, integrated over `length_units` down the fall line through each pixel; mean 0, deviation 1 where the fall line is
// straight (the sum of n correlated samples is normalized analytically). A streamline that comes to another surface, or where there is
// no fall line, goes straight on, so nothing crosses a silhouette. Pixels of tiles without any mark in `wanted` hold 0.
Grid<float> integrate_along_fall_line(const GuidanceBuffers& guidance, const Grid<std::uint8_t>& wanted, std::uint64_t seed,
                                      glm::ivec2 origin_px, double pixels_per_unit, double sigma_units, double length_units);

// The light on the ribs: about -1 … 1, mean 0. Only valid where `wanted` is marked. Reach: rib_margin_px().
Grid<float> make_ribs(const GuidanceBuffers& guidance, const Grid<std::uint8_t>& wanted, const RibParameters& parameters,
                      glm::ivec2 origin_px);
int rib_margin_px(double pixels_per_unit);

}  // namespace belvedere
