#pragma once

#include <string>
#include <vector>

namespace belvedere {

// All files that a raster is read from, itself first: its sidecar files (.prj, .tfw, .hdr, .aux.xml
// …), changes beside a database (-wal), and for a VRT its sources with their sidecar files. Each
// once, in alphabetical order. A URL has only itself. Opens them as raster_io.h does.
std::vector<std::string> raster_parts(const std::string& path);
// The same of vectors and tables: those of a shapefile (.dbf, .shx, .prj, .cpg), and changes beside
// a database. Opens nothing.
std::vector<std::string> vector_parts(const std::string& path);

}  // namespace belvedere
