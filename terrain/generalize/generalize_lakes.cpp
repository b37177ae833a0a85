#include "terrain/generalize/generalize_lakes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/filter.h"
#include "base/math.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

// The change that a kept lake would have had is also subtracted from the land around it, fading
// over this many cells: otherwise a lowered valley would leave its lake on a plateau.
constexpr float surroundings_cells = 32.0F;
// That change is averaged with this standard deviation, so that there are no seams between lakes;
// in blocks, because it is smooth.
constexpr int block_cells = 4;
constexpr double mean_cells = 10.0;
// Beyond the last blur of the subtracted change.
constexpr int reach_cells = 48;

// Squared distance from each cell to its nearest lake cell, cells²; out_of_reach beyond
// reach_cells. Computed in strips, because the nearest cells themselves would take twice the
// memory.
using Squares = Grid<std::uint16_t>;
constexpr int out_of_reach = 65535;

Squares shore_squares(const Grid<unsigned char>& keep) {
  const int width = keep.width();
  const int height = keep.height();
  Squares squares(width, height);
  constexpr int strip = 256;
  for (int first = 0; first < height; first += strip) {
    const int last = std::min(first + strip, height);
    const int top = std::max(first - reach_cells, 0);
    Grid<unsigned char> around(width, std::min(last + reach_cells, height) - top);
    std::copy_n(keep.row(top), around.size(), around.data());
    const Grid<std::int32_t> nearest = nearest_marked(around);
    parallel_rows(last - first, [&](int i) {
      const int y = first - top + i;
      for (int x = 0; x < width; ++x) {
        const std::int32_t shore = nearest(x, y);
        const std::int64_t across = shore % width - x;
        const std::int64_t down = shore / width - y;
        const std::int64_t square = across * across + down * down;
        const bool reached = shore >= 0 && square <= reach_cells * reach_cells;
        squares(x, first + i) = static_cast<std::uint16_t>(reached ? square : out_of_reach);
      }
    });
  }
  return squares;
}

// Distance from a cell to its nearest lake cell, cells; more than reach_cells if it is unknown.
float shore_distance(const Squares& squares, int x, int y) {
  return std::sqrt(static_cast<float>(squares(x, y)));
}

// The lengths above in cells of a halved DEM.
struct Lengths {
  explicit Lengths(int halved)
      : surroundings(std::ldexp(surroundings_cells, -halved)),
        mean(std::ldexp(mean_cells, -halved)),
        block(std::max(1, block_cells >> halved)),
        last(std::ldexp(1.5 * block_cells, -halved) / block) {}
  float surroundings;
  double mean;
  int block;
  double last;  // blur, blocks
};

// The change subtracted around lakes, in blocks of block_cells: the mean change of the lake cells
// nearby, fading with the distance. The last blur rounds the kinks of the distance halfway between
// two shores.
Grid<float> pull_of_lakes(const Grid<float>& change, const Grid<unsigned char>& keep,
                          const Squares& squares, const Lengths& lengths) {
  const int block_side = lengths.block;
  Grid<float> sum((change.width() + block_side - 1) / block_side,
                  (change.height() + block_side - 1) / block_side);
  Grid<float> count(sum.width(), sum.height());
  parallel_rows(sum.height(), [&](int block) {
    for (int y = block * block_side; y < std::min((block + 1) * block_side, change.height()); ++y) {
      for (int x = 0; x < change.width(); ++x) {
        if (keep(x, y) == 0) continue;
        sum(x / block_side, block) += change(x, y);
        count(x / block_side, block) += 1.F;
      }
    }
  });
  Grid<float> pull = gaussian_blur(sum, lengths.mean / block_side);
  count = gaussian_blur(count, lengths.mean / block_side);
  parallel_rows(pull.height(), [&](int y) {
    for (int x = 0; x < pull.width(); ++x) {
      const int centre_x = std::min(x * block_side + block_side / 2, change.width() - 1);
      const int centre_y = std::min(y * block_side + block_side / 2, change.height() - 1);
      const float fade =
          1.F - smoothstep(shore_distance(squares, centre_x, centre_y) / lengths.surroundings);
      pull(x, y) = count(x, y) > 0.F ? fade * pull(x, y) / count(x, y) : 0.F;
    }
  });
  return gaussian_blur(pull, lengths.last);
}

}  // namespace

void settle_around_kept(Grid<float>& change, const Grid<unsigned char>& keep, float fade_cells,
                        int halved) {
  if (std::none_of(keep.begin(), keep.end(), [](unsigned char k) { return k != 0; })) return;
  const Lengths lengths(halved);
  const int block = lengths.block;
  const float fade = std::ldexp(fade_cells, -halved);
  const Squares squares = shore_squares(keep);
  const Grid<float> pull = pull_of_lakes(change, keep, squares, lengths);
  parallel_rows(change.height(), [&](int y) {
    for (int x = 0; x < change.width(); ++x) {
      const float distance = shore_distance(squares, x, y);
      if (distance >= static_cast<float>(reach_cells)) continue;
      // Block centres of four cells lie at 1.5, 5.5, 9.5… cells.
      const double u = (x - 0.5 * (block - 1)) / block;
      const double v = (y - 0.5 * (block - 1)) / block;
      change(x, y) = (change(x, y) - sample_bspline(pull, u, v)) * smoothstep(distance / fade);
    }
  });
}

}  // namespace belvedere
