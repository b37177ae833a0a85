#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "base/grid.h"
#include "terrain/io/raster.h"

namespace belvedere {

// A river as places on a grid, a cell apart, downstream.
struct RiverLine {
  std::vector<glm::dvec2> places;    // cells
  std::vector<double> half_width_m;  // as it is drawn, at each place
  std::vector<bool> held;            // stays where it is: open water
};

// Water leaves level ground no trace in the cells of a DEM: it crosses them in straight lines and turns at right angles. Where the ground
// is level around a river it is rounded, and swings as rivers do, wider where it is larger: bends some twenty of its drawn widths long, and
// larger ones behind them. How far it swings is bound by how far the ground is level to all sides, and its ends stay. Bends hang on the
// seed and the place on the map alone.
void bend_on_level_ground(RiverLine& river, const Grid<float>& altitude_m, const GeoTransform& transform, std::uint64_t seed);

}  // namespace belvedere
