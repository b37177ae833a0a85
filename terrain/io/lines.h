#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace belvedere {

// A way on the map: a track, a road.
struct MapLine {
  std::string name;                // empty where the file says none
  std::string where;               // "tour.gpx, tracks 0"
  std::vector<glm::dvec2> places;  // x, y in the CRS that was asked for; 2 or more
};

// All lines of a file that read_map_features takes, in their order, in `crs` (WKT or a code): of GPX its tracks and routes; the parts of a
// line of several are lines of their own. Throws Error as read_map_features does, and Error(input) for a file without a line and for places
// that `crs` does not have.
std::vector<MapLine> read_lines(const std::string& path, const std::string& crs);

}  // namespace belvedere
