#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "base/grid.h"
#include "base/guidance_buffers.h"

namespace belvedere {

// Big planes of rock: a painter gives a wall a few faces, each in one tone, light ones against cool shadowed ones, with sharp edges
// between. Cells of a jittered grid (Worley 1996), drawn out along the local fall line, each with a tilt of its own; two sizes.
struct PlaneParameters {
  double pixels_per_unit = 1.0;  // a unit is 0.5 mm of the sheet
  double sun_side = 1.0;         // as in RibParameters: planes that are light for the one side are dark for the other
  std::uint64_t seed = 1;
};

// Light on the planes, -1 … 1, mean 0, where pixels are `marked`; 0 elsewhere. Every pixel stands alone; `origin_px` as in
// make_image_noise.
Grid<float> make_rock_planes(const GuidanceBuffers& guidance, const Grid<std::uint8_t>& marked, const PlaneParameters& parameters,
                             glm::ivec2 origin_px);

}  // namespace belvedere
