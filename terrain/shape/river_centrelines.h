#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "base/grid.h"
#include "terrain/io/dem.h"

namespace belvedere {

// A river or a stream of a map.
struct MappedRiver {
  std::vector<glm::dvec2> positions;  // m in the DEM's CRS, up or down the river
  double width_m = 0.0;               // 0: from the catchment
  double min_width_m = 0.0;           // minimum
  double snap_m = 150.0;  // maximum displacement to the bottom of its valley; 0: none; 0…2000
  int group = 0;          // lines of one group with a common end are one river
};

// Lines of a map joined into whole rivers.
struct JoinedLines {
  std::vector<MappedRiver> lines;
  std::size_t joined = 0;  // lines continued by another one
};

// Joins lines that end where exactly one other of their group does, with the width of the widest;
// lines of a single position are dropped. Where three meet, all end.
JoinedLines join_lines(const std::vector<MappedRiver>& drawn);

// A river fitted to the ground: smooth, with the width for drawing.
struct RiverCentreline {
  std::vector<glm::dvec2> positions;  // m in the DEM's CRS, at most a cell apart
  std::vector<float> half_width_m;    // at each position
  int group = 0;
};

struct RiverCentrelines {
  std::vector<RiverCentreline> lines;
  std::size_t outside = 0;    // lines that do not touch the ground
  std::size_t joined = 0;     // lines continued by another one
  double mean_moved_m = 0.0;  // mean displacement of all positions
  double max_moved_m = 0.0;
};

// Fits rivers of a map to a ground whose valleys may be slightly displaced. Each line is divided
// into steps of a cell. Across each step the positions within snap_m are evaluated by the catchment
// there relative to the largest of that cross-section, by their height above the lowest position of
// it, and by the distance to the map's line. The centreline is the path of least cost through all
// cross-sections (dynamic programming, Viterbi 1967), including a cost of turning away from the
// map's line, smoothed by some cells. A river that ends within that distance of a larger one flows
// into it. Its width is known_half_width_m(), or the map's if that is larger.
RiverCentrelines snap_rivers(const std::vector<MappedRiver>& drawn, const Dem& dem,
                             const Grid<float>& catchment_km2);

// 18 m · (area / 110 km²)^.458, at most 90 m: river_half_width_m() for a river known from a map,
// however small.
double known_half_width_m(double catchment_km2);

}  // namespace belvedere
