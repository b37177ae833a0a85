#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "base/grid.h"

namespace belvedere {

inline constexpr std::size_t no_reach = static_cast<std::size_t>(-1);

// One cell of a river and its neighbours along it.
struct RiverReach {
  glm::dvec2 position;        // cells
  double half_width_m = 0.0;  // set by the caller
  float catchment_km2 = 0.F;
  std::size_t downstream = no_reach;
  std::size_t upstream = no_reach;  // the larger one at a confluence
};

// All cells with at least `min_km2`, in the order of the grid, linked to the neighbour with the
// next larger catchment.
std::vector<RiverReach> find_reaches(const Grid<float>& catchment_km2, double min_km2);

// Moves each cell, and its width, towards the mean of the cells above and below it; springs and
// mouths are fixed. A tributary follows its mouth, without effect on the main river.
void smooth_reaches(std::vector<RiverReach>& reaches);

}  // namespace belvedere
