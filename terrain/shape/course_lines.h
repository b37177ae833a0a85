#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

namespace belvedere {

// A river or a stream as a map has it.
struct DrawnCourse {
  std::vector<glm::dvec2> places;  // m in the DEM's CRS, up or down the river
  double width_m = 0.0;            // 0: by what it has gathered
  double least_width_m = 0.0;      // never narrower
  double snap_m = 150.0;           // how far it may be moved to the bottom of its valley; 0: it stays; 0…2000
  int group = 0;                   // lines of one group that end in the same place are one river
};

// Lines of a map that became whole rivers.
struct JoinedLines {
  std::vector<DrawnCourse> lines;
  std::size_t joined = 0;  // lines that another one was continued by
};

// Lines that end where exactly one other of their group does become one, as wide as the widest of them; lines of one place are left out.
// Where three meet, all end.
JoinedLines join_lines(const std::vector<DrawnCourse>& drawn);

}  // namespace belvedere
