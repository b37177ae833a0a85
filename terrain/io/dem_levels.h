#pragma once

#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "base/progress.h"
#include "terrain/io/block_means.h"
#include "terrain/io/dem.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// A DEM larger than memory, as a pyramid of which only parts are held. Level 0 has the cells as
// read; each level halves the one before as base/pyramid.h's reduce does, so cell i of level k lies
// over cell 2^k i of level 0. This is the Gaussian pyramid in which terrain is generalized, so a
// coarser level is the same terrain without its finest bands.

// Cells along a side at a level.
int level_cells(int cells, int level);
// The level at which the whole takes a quarter of `max_cells`, which leaves the rest to windows; 0
// if all cells of the data fit.
int coarsest_level(const RasterFrame& frame, double max_cells);
// The level for previews: that with `max_cells` cells, or up to a third more.
int preview_level(const RasterFrame& frame, double max_cells);
// A DEM halved so many times. Water, where most cells below a coarser one are at one altitude,
// keeps that altitude.
Dem halved_dem(const Dem& dem, int times);
// Minimum memory for reading, besides the whole at its coarsest level: strips of rows, whole width.
double reading_bytes(const RasterFrame& frame);
// The transform of a level.
RasterFrame level_frame(const RasterFrame& frame, int level);

// reduce() of a raster whose rows come in strips, from the top. Voids are ignored: a cell is the
// weighted mean of the known ones under the kernel, and void if they have less than half of its
// weight.
class DemRowReducer {
 public:
  DemRowReducer(int width, int height) : width_(width), height_(height) {}
  // The coarser rows that can be computed from the rows so far; none or several. After the last
  // strip there are (height + 1) / 2.
  Grid<float> push(const Grid<float>& rows);

 private:
  int width_, height_;
  int made_ = 0;      // rows returned
  int first_ = 0;     // row of the raster at the start of kept_
  Grid<float> kept_;  // rows that later ones still need
};

class DemLevels {
 public:
  // Reads all cells once, in strips, and makes the levels up to `coarsest`. At most `kept_cells` of
  // them stay in memory, coarsest first; windows of finer ones are read again. Throws as read_dem
  // does.
  DemLevels(const DemParameters& parameters, const RasterFrame& frame, int coarsest,
            double kept_cells, Progress& progress);

  int coarsest() const { return coarsest_; }
  const RasterFrame& frame() const { return windows_.frame(); }
  // The whole at the coarsest level, its voids filled.
  Dem whole() const;
  // The whole as means of blocks of level 0, voids NaN, equal to those of a DEM held whole.
  Raster<float> blocks() const;
  // A rectangle of the cells of a level. Voids are filled from a coarser level of the whole, so
  // that all windows agree.
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
