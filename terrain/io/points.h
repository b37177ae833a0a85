#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terrain/io/features.h"

namespace belvedere {

// Points with their attributes as text: towns, names of summits.
struct PointTable {
  std::string file;                  // for messages
  std::vector<std::string> columns;  // attributes by the file's names
  struct Point {
    std::string where;                // "towns.csv:3", "towns.gpkg, feature 12"
    glm::dvec2 position{0.0};         // x, y in the requested CRS
    std::vector<std::string> values;  // as many as columns; empty if unknown
  };
  std::vector<Point> points;

  // The column of that name, case-insensitive; -1 if there is none.
  int find(std::string_view column) const;
  // The number in a column; nothing if the column is -1 or its field is empty. Error(usage) for
  // other text and beyond min … max. unit: for messages.
  std::optional<double> number(const Point& point, int column, double min, double max,
                               std::string_view unit = {}) const;
};

// The points of a CSV file with columns lon and lat (degrees) or east and north (of `crs`), or of a
// point layer, in `crs` (WKT or a code; empty: positions are unchanged, and degrees are rejected).
// If several layers have points, the one named "towns" is read. Formats of layers: GeoPackage,
// GeoJSON, shapefile, FlatGeobuf, by extension. Throws Error(usage) for another extension, for
// missing coordinate columns and for malformed numbers in a CSV; Error(input) for a file that is
// missing, damaged or without a CRS, for features that are not points, and for positions outside
// the valid area of `crs`; Error(limit) above 100000 points.
PointTable read_points(const VectorSource& source, const std::string& crs);

// The same, only for a layer.
PointTable read_point_layer(const VectorSource& source, const std::string& crs);

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
