#pragma once

#include <cstddef>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "base/progress.h"
#include "terrain/io/block_means.h"
#include "terrain/io/dem.h"
#include "terrain/io/raster_windows.h"

namespace belvedere {

// A DEM that is larger than memory, as a pyramid of which only parts are ever held. Level 0 are the cells as read; each level halves the
// one before as base/pyramid.h's reduce does, so cell i of level k lies over cell 2^k i of level 0: the same Gaussian pyramid in which
// terrain is generalized. What is coarser is therefore no other terrain, but the same without its finest bands.

// Cells of a side at a level.
int level_cells(int cells, int level);
// The level at which the whole takes a quarter of `most_cells`, which leaves the rest to windows; 0 where all cells of the data fit.
int coarsest_level(const RasterFrame& frame, double most_cells);
// Memory that reading takes at least, beside the whole at its coarsest level: strips of rows, whole width.
double reading_bytes(const RasterFrame& frame);
// Where the cells of a level lie.
RasterFrame level_frame(const RasterFrame& frame, int level);

// reduce() of a raster whose rows come in strips, from the top. A void takes no part: a cell is the mean of the known ones under the
// kernel, weighted by it, and void where they have less than half of its weight.
class DemRowReducer {
 public:
  DemRowReducer(int width, int height) : width_(width), height_(height) {}
  // The coarser rows that can be made now that these are known; none or several. After the last strip all (height + 1) / 2 are made.
  Grid<float> push(const Grid<float>& rows);

 private:
  int width_, height_;
  int made_ = 0;      // rows given out
  int first_ = 0;     // row of the raster that kept_ begins with
  Grid<float> kept_;  // rows that later ones still need
};

class DemLevels {
 public:
  // Reads all cells once, in strips, and makes the levels up to `coarsest`. Of those at most `kept_cells` stay in memory, coarsest first;
  // windows of finer ones are read again. Throws as read_dem does.
  DemLevels(const DemParameters& parameters, const RasterFrame& frame, int coarsest, double kept_cells, Progress& progress);

  int coarsest() const { return coarsest_; }
  const RasterFrame& frame() const { return windows_.frame(); }
  // The whole at the coarsest level, its voids filled.
  Dem whole() const;
  // The whole as means of blocks of level 0, voids NaN: as of a DEM that is held whole.
  Raster<float> blocks() const;
  // A rectangle of the cells of a level. Voids are filled from a coarser level of the whole, so that fills of all windows agree.
  Dem window(int level, const PixelRect& cells, const Dem& whole);

 private:
  Grid<float> read_level(int level, const PixelRect& cells);

  RasterWindows windows_;
  int coarsest_;
  int first_kept_ = 0;
  BlockMeans blocks_;
  std::vector<Grid<float>> kept_;  // levels first_kept_ … coarsest_, with their voids
};

}  // namespace belvedere
