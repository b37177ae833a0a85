#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "terrain/io/vector_source.h"

namespace belvedere {

// A line on the map: a track, a road.
struct MapLine {
  std::string name;                   // empty if the file has none
  std::string where;                  // "tour.gpx, tracks 0"
  std::vector<glm::dvec2> positions;  // x, y in the requested CRS; 2 or more
};

// All lines of a file of a format of read_map_features, in their order, in `crs` (WKT or a code):
// tracks and routes of GPX; parts of a multi-line are separate lines. Throws Error as
// read_map_features does, and Error(input) for a file without a line and for positions outside the
// valid area of `crs`.
std::vector<MapLine> read_lines(const VectorSource& source, const std::string& crs);

}  // namespace belvedere
