#pragma once

#include <string>
#include <utility>

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

}  // namespace belvedere
