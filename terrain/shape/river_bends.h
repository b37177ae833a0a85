#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "base/grid.h"
#include "terrain/io/raster.h"

namespace belvedere {

// A river as positions on a grid, a cell apart, downstream.
struct RiverLine {
  std::vector<glm::dvec2> positions;  // cells
  std::vector<double> half_width_m;   // as drawn, at each position
  std::vector<bool> held;             // fixed: open water
};

// On level ground a DEM has no channels: drainage crosses it in straight lines and right angles.
// Where the ground is level around a river, its line is rounded and meanders with an amplitude that
// grows with the river: bends some twenty drawn widths long, superposed on larger ones. The
// amplitude is limited by the extent of the level ground on all sides, and the ends are fixed.
// Bends depend only on the seed and the position on the map.
void bend_on_level_ground(RiverLine& river, const Grid<float>& altitude_m,
                          const GeoTransform& transform, std::uint64_t seed);

}  // namespace belvedere
