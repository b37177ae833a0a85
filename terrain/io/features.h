#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace belvedere {

// One file of points, lines or areas, and its settings in a scene. A path alone is a file that
// states everything itself.
struct VectorSource {
  VectorSource() = default;
  VectorSource(std::string file) : path(std::move(file)) {}
  VectorSource(const char* file) : path(file) {}

  std::string path;
  // Overrides or supplies the file's CRS; of a .csv that of its columns east and north, which
  // otherwise are in the terrain's. Empty: the file's own.
  std::string crs;
  // Encoding of the texts of a .shp or .csv ("windows-1252"); empty: as its .cpg says, or UTF-8.
  // Other formats are always UTF-8.
  std::string encoding;
};

enum class MapShape : int { point, line, area };

// A feature of a map with its attributes.
struct MapFeature {
  MapShape shape = MapShape::line;
  std::string where;  // "roads.gpkg, lines 12", for messages
  // x, y in the requested CRS. A point has one position; a line one row of at least 2; an area its
  // outline and then its holes, each of at least 3 without the closing one.
  std::vector<std::vector<glm::dvec2>> parts;
  std::vector<std::string> values;  // one per requested column, including `also`; empty if unknown
};

// A part of the map, in the requested CRS.
struct MapBox {
  glm::dvec2 low{0.0}, high{0.0};
};

// Selects the features of a file and their attributes.
struct MapQuery {
  std::string layer = {};  // empty: all layers
  std::string where = {};  // attribute filter, as SQL's WHERE; empty: all
  std::vector<std::string> columns =
      {};                              // case-insensitive; an error if no layer of the file has one
  std::vector<std::string> also = {};  // optional columns; their values follow those of `columns`
  std::optional<MapBox> box =
      {};  // features outside are counted and dropped; empty: everything is kept
  std::size_t max_positions = 30000000;  // of all features that are kept; more are an error
};

struct MapFeatures {
  std::vector<MapFeature>
      features;  // in the order of the file; parts of a multi-geometry are separate features
  std::size_t read = 0;           // features in the file
  std::size_t without_shape = 0;  // of these: without geometry, or with too few positions
  std::size_t unplaceable = 0;    // with a position that does not exist in the requested CRS
  std::size_t at_zero = 0;  // with all positions 0, 0 in the file's own coordinates: missing values
  std::size_t beside = 0;   // outside the box
  MapBox extent = {};       // of all features with a position, also outside the box
};

// The points, lines and areas of a vector file in `crs` (WKT or a code): GeoPackage, GeoJSON,
// shapefile, FlatGeobuf, GPX, OpenStreetMap's XML and PBF, by extension. Features are read in
// portions, so a file may be much larger than the part in the box. Areas may intersect themselves:
// they contain what an odd number of their rings encloses. Throws Error(usage) for another
// extension or an invalid layer, column or filter; Error(input) for a file that is missing, damaged
// or without a CRS; Error(limit) for more than 2 · 10⁶ features or `max_positions` that are kept.
MapFeatures read_map_features(const VectorSource& source, const MapQuery& query,
                              const std::string& crs);

}  // namespace belvedere
