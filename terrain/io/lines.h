#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace belvedere {

// A way on the map: a track, a road.
struct MapLine {
  std::string name;                // empty where the file says none
  std::string where;               // "tour.gpx, feature 0"
  std::vector<glm::dvec2> places;  // x, y in the CRS that was asked for; 2 or more
};

// All lines of a file's layers, in their order, in `crs` (WKT or a code): of GPX its tracks and routes, of GeoJSON, GeoPackage, shapefile
// and FlatGeobuf every line; the parts of a line of several are lines of their own. Throws Error(usage) for another ending; Error(input)
// for a file that is missing, damaged, without a CRS or without a line, and for places that `crs` does not have; Error(limit) over 10⁶
// places.
std::vector<MapLine> read_lines(const std::string& path, const std::string& crs);

}  // namespace belvedere
