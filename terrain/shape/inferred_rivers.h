#pragma once

#include <cstddef>
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

// Rivers inferred from the terrain: lines along the drainage of a catchment grid, smoothed, each
// from its spring to where it flows into a larger one. On relief a line stays within a cell of the
// drainage, which is the bottom of its valley; only level ground lets it leave that, and
// there a river that runs beside a larger one joins it. `bed` gives
// the role of a cell of the grid. A line ends within two cells of open water, fades in and out over
// some cells where its bed begins and ends on dry ground, and keeps its width at mouths and at the
// border of the grid. Grids of one size. Group 0.
std::vector<RiverCentreline> infer_rivers_of_ground(
    const Grid<float>& catchment_km2, const Grid<float>& altitude_m, const GeoTransform& transform,
    const std::function<RiverBed(int x, int y)>& bed,
    const InferredRiverParameters& parameters = {});

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

// Moves each cell, and its width, towards the mean of the cells above and below it, at most as far
// as its leash (cells; one for each, or none at all); springs and mouths are fixed. A tributary
// follows its mouth, without effect on the main river.
void smooth_reaches(std::vector<RiverReach>& reaches, const std::vector<double>& leashes = {});

}  // namespace belvedere
