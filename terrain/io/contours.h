#pragma once

#include <string>
#include <vector>

#include "terrain/io/raster.h"

namespace belvedere {

struct ContourParameters {
  double interval_m = 100.0;  // between lines; > 0
  double base_m = 0.0;        // altitude of one of the lines
};

// What was written, for reports: the length falls as terrain is generalized.
struct ContourSummary {
  int lines = 0;
  double length = 0.0;  // in CRS units (m)
};

// Contour lines as a GeoPackage (.gpkg), GeoJSON (.geojson, in the raster's CRS) or shapefile
// (.shp), with the attribute altitude_m. Voids (NaN) have none. An existing file is replaced only
// when all is written. Throws Error(usage) for an invalid interval, Error(output) naming the file.
ContourSummary write_contours(const std::string& path, const Raster<float>& raster,
                              const ContourParameters& parameters);
// The files that it writes: for .shp several.
std::vector<std::string> contour_files(const std::string& path);

}  // namespace belvedere
