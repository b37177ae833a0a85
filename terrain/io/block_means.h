#pragma once

#include <cstdint>
#include <vector>

#include "base/function_ref.h"
#include "base/grid.h"

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

}  // namespace belvedere
