#pragma once

#include <cstdint>
#include <optional>

#include "base/grid.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "terrain/io/raster.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// A terrain at low resolution: means of square blocks of its cells, as used for finding views. They
// are equal for a terrain held whole and for one read in strips, so that results do not depend on
// the memory of a machine.
constexpr int usual_blocks = 420;  // along the longer side

class BlockMeans {
 public:
  // The block size that gives at most `max_blocks` along the longer side.
  BlockMeans(int width, int height, int max_blocks = usual_blocks);
  // The next rows, whole width; voids are NaN. The same bits however the rows are cut.
  void push(const Grid<float>& rows);
  // Cells along a side of a block.
  int factor() const { return factor_; }
  // At least two along a side; NaN if less than half of a block is known.
  Grid<float> means() const;

 private:
  int factor_;
  int row_ = 0;  // the next
  Grid<double> sums_;
  Grid<std::int32_t> counts_;
};

// Means of blocks of `factor` × `factor` cells; blocks at the right and lower border may be
// incomplete.
Grid<float> block_means(const Grid<float>& values, int factor);
// The same of values that are not in a grid: fill_row(y, row) writes a row of `width` of them.
Grid<float> block_means(int width, int height, int factor,
                        FunctionRef<void(int y, float* row)> fill_row);

// A preview of a file that is too large to read: at most `longest` of its cells per side, evenly
// spaced, unchanged from the file (or only from its overviews, if it has some). In the file's own
// CRS; metres, voids NaN. Nothing if its cells are rotated. Notes what was taken as void
// though no header says so. Throws as in raster_io.h.
std::optional<Raster<float>> read_thinned(const RasterSource& source, int longest,
                                          Progress& progress = silent_progress());

}  // namespace belvedere
