#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "terrain/io/raster.h"
#include "terrain/io/raster_file.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// A river that flows into a DEM that is a window of a larger one.
struct RiverEntry {
  int x = 0, y = 0;  // the cell at which it enters
  double km2 = 0.0;  // its catchment outside
};

// A digital elevation model ready for use: metric CRS, nearly square cells, no voids.
struct Dem {
  Grid<float> altitude_m;     // above the vertical datum; finite everywhere
  Grid<std::uint8_t> filled;  // 1 where a void was filled: such terrain is painted but dissolves in
                              // haze at the edge
  GeoTransform transform;
  std::string crs;  // WKT2
  // For terrain that is larger than memory (dem_levels.h):
  std::vector<RiverEntry> entries;  // empty if the surroundings are unknown
  int halved = 0;                   // number of halvings from the data to these cells

  int width() const { return altitude_m.width(); }
  int height() const { return altitude_m.height(); }
  // Mean side of a cell, m.
  double cell_m() const { return 0.5 * (transform.cell_x + transform.cell_y); }
  // Standard deviation, cells, of the Gaussian that these cells need for one of sigma_m in the
  // data: halving has blurred them by a variance of .3 (4^halved - 1) cells of the data.
  double blur_cells(double sigma_m) const;
};

struct DemParameters {
  std::vector<RasterSource> sources;
  std::string crs;      // metric CRS of the scene; empty: the first source's, or its UTM zone
  double cell_m = 0.0;  // 0: the finest source's; 0.1…10000
  std::optional<std::array<double, 4>> extent;  // min x, min y, max x, max y in the scene's CRS
  double max_void_share = 0.25;                 // 0…1; more voids than that is an error
};

// Reads, mosaics, reprojects, converts feet, fills voids (smooth continuation from the border:
// coarse to fine) and masks them. Throws Error(input) for unusable data, Error(limit) if it exceeds
// memory.
Dem read_dem(const DemParameters& parameters, Progress& progress);
// The cells of one file as they are, in its own CRS or none; judged and filled like read_dem's, of
// any share of voids.
Dem read_own_dem(const RasterSource& source, Progress& progress);
// Fills NaN cells and marks them; shared by read_dem and synthetic or in-memory terrain.
Dem make_dem(Raster<float> raster);

// Relaxes void cells towards Laplace's equation: each becomes the mean of its neighbours, with
// known ones fixed. What they begin with has already solved the coarse scales, so a few iterations
// suffice for the cell scale and for a continuous border. Each iteration reads the previous one
// (Jacobi, undamped: the coarse start has no checkerboard), so order does not matter.
void relax_voids(Grid<float>& z, const std::vector<std::size_t>& voids);

// Checks for implausible elevation. Every command that reads elevation calls both functions, so
// that all give the same errors and notes.

// Plausible altitudes, m: from the Challenger Deep (-10935) to Everest (8849), with a margin.
constexpr float lowest_ground_m = -11000.F;
constexpr float highest_ground_m = 9000.F;

// Before the cells are read. Throws Error(input) for a band of colours instead of heights: a shaded
// relief, a rendered map, a palette. Notes on files of 8 bits, on heights without a unit
// under a coordinate system in feet, and on files whose centre lies far outside the area of use of
// their coordinate system (doubt_of_place). Returns the sources as their cells are to be read:
// - 0 is void where it marks cells outside an outline: the median step to the ground beside it is
//   larger than at a coast. Noted.
// - Spikes of single cells are void: RasterSource::max_spike_m.
std::vector<RasterSource> check_height_sources(const std::vector<RasterSource>& sources,
                                               Progress& progress);

// After reading: notes on the cells that were taken as void though no header says so.
void note_dropped_cells(const RasterFile& file, Progress& progress);

// After reading: notes on heights below the lowest or above the highest ground, with the keys that
// help.
void note_height_range(const std::string& where, float lowest_m, float highest_m,
                       Progress& progress);

}  // namespace belvedere
