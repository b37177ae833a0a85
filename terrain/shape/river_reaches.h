#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "base/grid.h"

namespace belvedere {

inline constexpr std::size_t no_reach = static_cast<std::size_t>(-1);

// One cell of a river and its neighbours along it.
struct RiverReach {
  glm::dvec2 place;           // cells
  double half_width_m = 0.0;  // for whoever looks for them to set
  float catchment_km2 = 0.F;
  std::size_t downstream = no_reach;
  std::size_t upstream = no_reach;  // the larger one where two meet
};

// Every cell of at least `least_km2`, in the order of the grid, linked to the neighbour whose catchment is the next larger.
std::vector<RiverReach> find_reaches(const Grid<float>& catchment_km2, double least_km2);

// Moves each cell, and its width, towards the mean of the cells above and below it; springs and mouths stay. A tributary follows its mouth,
// the main river does not feel it.
void smooth_reaches(std::vector<RiverReach>& reaches);

}  // namespace belvedere
