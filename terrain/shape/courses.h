#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

#include "base/grid.h"
#include "terrain/io/dem.h"
#include "terrain/shape/course_lines.h"

namespace belvedere {

// A river laid into the ground: smooth, with the width that it is drawn with.
struct Course {
  std::vector<glm::dvec2> places;   // m in the DEM's CRS, a cell apart or less
  std::vector<float> half_width_m;  // at each place
  int group = 0;
};

struct Courses {
  std::vector<Course> lines;
  std::size_t outside = 0;    // drawn lines that do not touch the ground
  std::size_t joined = 0;     // lines that another one was continued by
  double mean_moved_m = 0.0;  // of all places
  double most_moved_m = 0.0;
};

// Lays rivers of a map into a ground whose valleys may lie a little beside theirs. Each line is cut into steps of a cell; across each step
// the places within snap_m are judged by how much water the ground itself leads there (the larger the catchment against the largest of
// that cross-section the better), how high they lie over the lowest of it, and how far they are from where the map has the river. The
// course is the way of least cost through all cross-sections (dynamic programming, as by Viterbi 1967), where turning away from the map's
// line costs as well, smoothed by some cells. Where a river ends within that distance of a larger one it flows into
// it. Its width is known_half_width_m(), or the map's where that is larger.
Courses lay_courses(const std::vector<DrawnCourse>& drawn, const Dem& dem, const Grid<float>& catchment_km2);

// 18 m · (area / 110 km²)^.458, at most 90 m: river_half_width_m() where the map says that there is a river, however small.
double known_half_width_m(double catchment_km2);

}  // namespace belvedere
