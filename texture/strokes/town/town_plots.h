#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "base/random_streams.h"
#include "texture/strokes/stroke_seeds.h"

namespace belvedere {

// A position for a house in a row along a street: a cell of a lattice on the ground that is as fine
// as houses on the sheet allow.
struct Plot {
  std::uint64_t key;   // of the cell, for random numbers
  double away_px;      // from the pixel where it was found
  glm::vec2 position;  // px
  std::uint32_t pixel;
  bool street;                             // left open: a lane across the rows
  glm::vec2 lane_from{0.F}, lane_to{0.F};  // px: its part of the lane; equal where it is at none
};

// All plots of the picture, each once: found from the nearest pixel of a grid that is finer than
// the plots.
std::vector<Plot> find_plots(const StrokeScene& scene, Stream stream);

}  // namespace belvedere
