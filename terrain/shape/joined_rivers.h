#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

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

}  // namespace belvedere
