#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace belvedere {

// Points with what a file says of each, as text: towns, names of summits.
struct PointTable {
  std::string file;                  // for messages
  std::vector<std::string> columns;  // attributes by the file's names
  struct Point {
    std::string where;                // "towns.csv:3", "towns.gpkg, feature 12"
    glm::dvec2 place{0.0};            // x, y in the CRS that was asked for
    std::vector<std::string> values;  // as many as columns; empty where nothing is known
  };
  std::vector<Point> points;

  // The column of that name, small and capital letters alike; -1 where there is none.
  int find(std::string_view column) const;
};

// The points of a CSV file with columns lon and lat (degrees) or east and north (of `crs`), or of a layer of points, in `crs` (WKT or a
// code; empty: places stay as they are, and degrees are refused). Of several layers that have points the one named "towns" is read. Formats
// of layers: GeoPackage, GeoJSON, shapefile, FlatGeobuf, by their endings and no others. Throws Error(usage) for another ending, for
// columns that give no place and for a CSV's text that is no number; Error(input) for a file that is missing, damaged or without a CRS, for
// features that are no points, and for places that `crs` does not have; Error(limit) over 100000 points.
PointTable read_points(const std::string& path, const std::string& crs);

// The same of a layer alone.
PointTable read_point_layer(const std::string& path, const std::string& crs);

}  // namespace belvedere
