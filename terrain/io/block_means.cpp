#include "terrain/io/block_means.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "terrain/io/dem.h"
#include "terrain/io/raster_file.h"

namespace belvedere {
namespace {

int blocks_of(int cells, int factor) { return std::max(2, (cells + factor - 1) / factor); }

}  // namespace

BlockMeans::BlockMeans(int width, int height, int max_blocks)
    : factor_(std::max(1, (std::max(width, height) + max_blocks - 1) / max_blocks)),
      sums_(blocks_of(width, factor_), blocks_of(height, factor_), 0.0),
      counts_(sums_.width(), sums_.height(), 0) {}

void BlockMeans::push(const Grid<float>& rows) {
  // A block gets its cells row by row, for any split into rows; adjacent blocks are independent.
  parallel_ranges(static_cast<std::size_t>(sums_.width()), std::size_t{16},
                  [&](std::size_t begin, std::size_t end) {
                    for (int y = 0; y < rows.height(); ++y) {
                      const int block_y = (row_ + y) / factor_;
                      const float* row = rows.row(y);
                      for (int block_x = static_cast<int>(begin); block_x < static_cast<int>(end);
                           ++block_x) {
                        double& sum = sums_(block_x, block_y);
                        std::int32_t& count = counts_(block_x, block_y);
                        for (int x = block_x * factor_;
                             x < std::min((block_x + 1) * factor_, rows.width()); ++x) {
                          if (std::isnan(row[x])) continue;
                          sum += static_cast<double>(row[x]);
                          ++count;
                        }
                      }
                    }
                  });
  row_ += rows.height();
}

Grid<float> BlockMeans::means() const {
  Grid<float> out(sums_.width(), sums_.height());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = counts_[i] > 0 && 2 * counts_[i] >= factor_ * factor_
                 ? static_cast<float>(sums_[i] / counts_[i])
                 : std::numeric_limits<float>::quiet_NaN();
  return out;
}

Grid<float> block_means(int width, int height, int factor,
                        FunctionRef<void(int y, float* row)> fill_row) {
  Grid<float> out((width + factor - 1) / factor, (height + factor - 1) / factor);
  parallel_rows(out.height(), [&](int j) {
    std::vector<float> row(static_cast<std::size_t>(width));
    std::vector<double> sums(static_cast<std::size_t>(out.width()), 0.0);
    const int y1 = std::min(height, (j + 1) * factor);
    for (int y = j * factor; y < y1; ++y) {
      fill_row(y, row.data());
      for (int i = 0; i < out.width(); ++i) {
        const int x1 = std::min(width, (i + 1) * factor);
        for (int x = i * factor; x < x1; ++x)
          sums[static_cast<std::size_t>(i)] +=
              static_cast<double>(row[static_cast<std::size_t>(x)]);
      }
    }
    for (int i = 0; i < out.width(); ++i) {
      const int count = (std::min(width, (i + 1) * factor) - i * factor) * (y1 - j * factor);
      out(i, j) = static_cast<float>(sums[static_cast<std::size_t>(i)] / count);
    }
  });
  return out;
}

Grid<float> block_means(const Grid<float>& values, int factor) {
  if (factor == 1) return values;
  return block_means(values.width(), values.height(), factor,
                     [&](int y, float* row) { std::copy_n(values.row(y), values.width(), row); });
}

std::optional<Raster<float>> read_thinned(const RasterSource& source, int longest,
                                          Progress& progress) {
  const RasterFile file(source);
  const CellAffine& a = file.affine();
  if (!a.axis_aligned() || a.x_column <= 0.0 || a.y_row >= 0.0) return std::nullopt;
  const int factor = std::max(1, (std::max(file.width(), file.height()) + longest - 1) / longest);
  const int width = std::max(1, file.width() / factor);
  const int height = std::max(1, file.height() / factor);
  Raster<float> out;
  out.cells = file.read_values({0, 0, file.width(), file.height()}, width, height);
  note_dropped_cells(file, progress);
  out.crs = file.required_crs();
  out.transform = {a.x0, a.y0, a.x_column * file.width() / width,
                   -a.y_row * file.height() / height};
  return out;
}

}  // namespace belvedere
