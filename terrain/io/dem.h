#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "terrain/io/raster.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// Water that comes from beyond a DEM which is a window of a larger one.
struct RiverEntry {
  int x = 0, y = 0;  // the cell in which it arrives
  double km2 = 0.0;  // what it has gathered outside
};

// A digital elevation model ready for work: metric CRS, square-ish cells, no voids left.
struct Dem {
  Grid<float> altitude_m;     // above the vertical datum; finite everywhere
  Grid<std::uint8_t> filled;  // 1 where a void was filled: such terrain is painted but dissolves in haze at the rim
  GeoTransform transform;
  std::string crs;  // WKT2
  // Of terrain that is larger than memory (dem_levels.h):
  std::vector<RiverEntry> entries;  // empty where nothing is known of what lies outside
  int halved = 0;                   // how many times the data were halved to these cells

  int width() const { return altitude_m.width(); }
  int height() const { return altitude_m.height(); }
  // Mean side of a cell, m.
  double cell_m() const { return 0.5 * (transform.cell_x + transform.cell_y); }
};

struct DemParameters {
  std::vector<RasterSource> sources;
  std::string crs;                              // metric CRS of the scene; empty: the first source's, or its UTM zone
  double cell_m = 0.0;                          // 0: the finest source's; 0.1…10000
  std::optional<std::array<double, 4>> extent;  // min x, min y, max x, max y in the scene's CRS
  double max_void_share = 0.25;                 // 0…1; more voids than that is an error
};

// Reads, mosaics, reprojects, converts feet, fills voids (smooth continuation from the rim: coarse to fine) and masks them.
// Throws Error(input) for unusable data, Error(limit) for a size over memory.
Dem read_dem(const DemParameters& parameters, Progress& progress);
// Fills NaN cells and marks them; the part read_dem shares with synthetic and in-memory terrain.
Dem make_dem(Raster<float> raster);

}  // namespace belvedere
