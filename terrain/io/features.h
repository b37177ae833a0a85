#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace belvedere {

enum class MapShape : int { point, line, area };

// One thing on the map, with what its file says of it.
struct MapFeature {
  MapShape shape = MapShape::line;
  std::string where;  // "roads.gpkg, lines 12", for messages
  // x, y in the CRS that was asked for. A point's one place; a line's one row of 2 and more; an area's outline and then its holes, each of
  // 3 and more without the closing one.
  std::vector<std::vector<glm::dvec2>> parts;
  std::vector<std::string> values;  // as many as columns asked for, `also` included; empty where nothing is known
};

// A part of the map, in the CRS that was asked for.
struct MapBox {
  glm::dvec2 low{0.0}, high{0.0};
};

// Which features of a file are read, and what of them.
struct MapQuery {
  std::string layer = {};                 // empty: all layers
  std::string where = {};                 // filter by attributes, as SQL's WHERE; empty: all
  std::vector<std::string> columns = {};  // small and capital letters alike; a file of which no layer has one is refused
  std::vector<std::string> also = {};     // columns that no layer need have; their values follow those of `columns`
  std::optional<MapBox> box = {};         // what lies beside it is counted and let go; empty: everything is kept
};

struct MapFeatures {
  std::vector<MapFeature> features;  // in the order of the file; several parts of one are features of their own
  std::size_t read = 0;              // features that the file gave
  std::size_t without_shape = 0;     // of these: without geometry, or with one of too few places
  std::size_t unplaceable = 0;       // with a place that the CRS asked for does not have
  std::size_t at_zero = 0;           // all of whose places are 0, 0 in the file's own coordinates: nobody wrote them down
  std::size_t beside = 0;            // beside the box
  MapBox extent = {};                // of all that has a place, beside the box as well
};

// The points, lines and areas of a vector file in `crs` (WKT or a code): GeoPackage, GeoJSON, shapefile, FlatGeobuf, GPX, OpenStreetMap's
// XML and PBF, by their endings and no others. Features are read a part of the file at a time, so that a file may be much larger than what
// of it lies in the box. Areas may cross themselves: what an odd number of their rings encloses belongs to them. Throws Error(usage) for
// another ending, a layer, column or filter that the file does not understand; Error(input) for a file that is missing, damaged or without
// a CRS; Error(limit) for more than 2 · 10⁶ features or 3 · 10⁷ places that are kept.
MapFeatures read_map_features(const std::string& path, const MapQuery& query, const std::string& crs);

}  // namespace belvedere
