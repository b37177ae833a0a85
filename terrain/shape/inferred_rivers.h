#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "base/grid.h"
#include "terrain/io/raster.h"
#include "terrain/shape/river_centrelines.h"

namespace belvedere {

struct InferredRiverParameters {
  double min_km2 = 20.0;  // catchment at which brooks fade in, > 0
  double full_km2 =
      45.0;  // … and at which they have the full width of known_half_width_m(), > min_km2
  int min_cells = 12;      // shorter pieces are dropped
  int closed_cells = 6;    // dry gaps up to this many cells are closed
  std::uint64_t seed = 1;  // of their bends
};

// Role of a position on the ground for a river.
enum class RiverBed {
  dry,   // no river here
  runs,  // its bed
  open   // a lake or the sea, which it flows into or out of
};

// Rivers inferred from the terrain: lines along the drainage of a catchment grid, smoothed by some
// cells, each from its spring to where it flows into a larger one. `bed` gives the role of a cell
// of the grid. A line ends within two cells of open water, fades in and out over some cells where
// its bed begins and ends on dry ground, and keeps its width at mouths and at the border of the
// grid. On level ground it bends (river_bends.h). Grids of one size. Group 0.
std::vector<RiverCentreline> infer_rivers_of_ground(
    const Grid<float>& catchment_km2, const Grid<float>& altitude_m, const GeoTransform& transform,
    const std::function<RiverBed(int x, int y)>& bed,
    const InferredRiverParameters& parameters = {});

}  // namespace belvedere
