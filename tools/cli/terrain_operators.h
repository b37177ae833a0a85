#pragma once

#include <cstdint>
#include <string>

#include "base/grid.h"
#include "base/progress.h"
#include "terrain/io/raster.h"
#include "terrain/io/raster_io.h"
#include "tools/options/options.h"

namespace belvedere::tools {

class CommandOptions;

// Operators on a DEM before and after the bands are weighted, and products of the result besides
// the DEM.
struct TerrainOperators {
  bool destripe = false;
  bool line_integral = false;
  float widen_valleys_m = 0.F;
  std::string hillshade;  // file, empty: none
  std::string contours;   // file, empty: none
  double contour_interval_m = 100.0;
};

// --destripe, --line-integral, --widen-valleys, --hillshade, --contours, --contour-interval.
void add_terrain_operators(CommandOptions& command, TerrainOperators& operators);

// Cells finite, m. `keep`: lakes, which do not change; `mask`: as of the bands; empty: none.
Grid<float> operate_after_bands(const Grid<float>& altitude_m, const Grid<std::uint8_t>& keep,
                                const Grid<float>& mask, double cell_m,
                                const TerrainOperators& operators, Progress& progress);
// Hillshade and contours of the result; voids are NaN, its CRS metric.
void write_products(const Raster<float>& result, const TerrainOperators& operators,
                    Progress& progress);

// Options of every command that reads elevation without a scene: what a scene says in the keys of
// terrain.sources.
struct ElevationOptions {
  std::string encoding, variable;
};
void add_elevation_options(CommandOptions& command, ElevationOptions& options);

RasterSource elevation_source(const std::string& path, const ElevationOptions& options);

}  // namespace belvedere::tools
