#pragma once

#include <cstdint>
#include <vector>

#include "base/function_ref.h"
#include "base/grid.h"

namespace belvedere {

// A terrain from afar: means of square blocks of its cells, as many as views are looked for in. They are the same for a terrain that is
// held whole and for one that is only read in strips, so that what follows from them does not hang on the memory of a machine.
constexpr int usual_blocks = 420;  // of the longer side

class BlockMeans {
 public:
  // Blocks of as many cells as leave at most `most_blocks` of the longer side.
  BlockMeans(int width, int height, int most_blocks = usual_blocks);
  // The next rows, whole width; voids are NaN. The same bits however the rows are cut.
  void push(const Grid<float>& rows);
  // Cells of a side of a block.
  int factor() const { return factor_; }
  // Two at least of a side; NaN where less than half of a block is known.
  Grid<float> means() const;

 private:
  int factor_;
  int row_ = 0;  // the next
  Grid<double> sums_;
  Grid<std::int32_t> counts_;
};

// Means of blocks of `factor` × `factor` cells; blocks at the right and lower rim are of what there is.
Grid<float> block_means(const Grid<float>& values, int factor);
// The same of values that are in no grid: fill_row(y, row) writes a row of `width` of them.
Grid<float> block_means(int width, int height, int factor, FunctionRef<void(int y, float* row)> fill_row);

}  // namespace belvedere
