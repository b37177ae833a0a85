#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "base/grid.h"
#include "terrain/io/raster.h"
#include "terrain/shape/courses.h"

namespace belvedere {

struct GuessedCourseParameters {
  double least_km2 = 20.0;  // brooks come up from nothing where so much drains through, > 0
  double full_km2 = 45.0;   // … and have the whole width of known_half_width_m() here, above the least
  int least_cells = 12;     // shorter pieces are none
  int closed_cells = 6;     // gaps up to so many cells, between water and water, are closed
  std::uint64_t seed = 1;   // of their bends
};

// What a place of the ground is for a river.
enum class RiverBed {
  dry,   // none runs here
  runs,  // its bed
  open   // a lake or the sea, which it flows into or out of
};

// Rivers that a ground has by its own fall: lines down the water of a catchment grid, smoothed by some cells, each from its spring to where
// it flows into a larger one. `bed` tells of a cell of the grid what it is; a line ends within two cells of open water, comes up
// and fades over some cells where its bed begins and ends on dry ground, and keeps its width at mouths and at the rim of the grid. On level
// ground it bends (river_bends.h). Grids of one size. Group 0.
std::vector<Course> guess_courses(const Grid<float>& catchment_km2, const Grid<float>& altitude_m, const GeoTransform& transform,
                                  const std::function<RiverBed(int x, int y)>& bed, const GuessedCourseParameters& parameters = {});

}  // namespace belvedere
