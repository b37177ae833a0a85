#include "terrain/generalize_lakes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "renderer/base/filter.h"
#include "renderer/base/parallel.h"

namespace belvedere {
namespace {

// The change that a kept lake would have had is taken off the land around it as well, less and less over so many cells: a
// valley whose floor sinks must not leave its lake on a table.
constexpr float surroundings_cells = 32.0F;
// That change is a mean over this deviation, so that no seams run between lakes; in blocks, because it is smooth.
constexpr int block_cells = 4;
constexpr double mean_cells = 10.0;
// What is left of the change at the shore itself fades in over so many cells.
constexpr float shore_cells = 6.0F;
float unit(float v) { return std::clamp(v, 0.F, 1.F); }

float smoothstep(float t) { return t * t * (3.F - 2.F * t); }

// Distance from a cell to its nearest lake cell, cells; there is a lake.
float shore_distance(const Grid<std::int32_t>& nearest, int x, int y) {
  const std::int32_t shore = nearest(x, y);
  const int across = shore % nearest.width() - x;
  const int down = shore / nearest.width() - y;
  const auto dx = static_cast<float>(across);
  const auto dy = static_cast<float>(down);
  return std::sqrt(dx * dx + dy * dy);
}

// What lakes take off the change around them, in blocks of block_cells: the mean change of the lake cells nearby, fading with the
// distance. The last blur rounds the creases that the distance has halfway between two shores.
Grid<float> pull_of_lakes(const Grid<float>& change, const Grid<unsigned char>& keep, const Grid<std::int32_t>& nearest) {
  Grid<float> sum((change.width() + block_cells - 1) / block_cells, (change.height() + block_cells - 1) / block_cells);
  Grid<float> count(sum.width(), sum.height());
  parallel_rows(sum.height(), [&](int block) {
    for (int y = block * block_cells; y < std::min((block + 1) * block_cells, change.height()); ++y) {
      for (int x = 0; x < change.width(); ++x) {
        if (keep(x, y) == 0) continue;
        sum(x / block_cells, block) += change(x, y);
        count(x / block_cells, block) += 1.F;
      }
    }
  });
  Grid<float> pull = gaussian_blur(sum, mean_cells / block_cells);
  count = gaussian_blur(count, mean_cells / block_cells);
  parallel_rows(pull.height(), [&](int y) {
    for (int x = 0; x < pull.width(); ++x) {
      const int middle_x = std::min(x * block_cells + block_cells / 2, change.width() - 1);
      const int middle_y = std::min(y * block_cells + block_cells / 2, change.height() - 1);
      const float fade = 1.F - smoothstep(unit(shore_distance(nearest, middle_x, middle_y) / surroundings_cells));
      pull(x, y) = count(x, y) > 0.F ? fade * pull(x, y) / count(x, y) : 0.F;
    }
  });
  return gaussian_blur(pull, 1.5);
}

}  // namespace

void settle_around_lakes(Grid<float>& change, const Grid<unsigned char>& keep) {
  const Grid<std::int32_t> nearest = nearest_marked(keep);
  const Grid<float> pull = pull_of_lakes(change, keep, nearest);
  parallel_rows(change.height(), [&](int y) {
    for (int x = 0; x < change.width(); ++x) {
      const float distance = shore_distance(nearest, x, y);
      if (distance >= 1.5F * surroundings_cells) continue;  // beyond the reach of the last blur
      // Block centres lie at 1.5, 5.5, 9.5… cells.
      const double u = (x - 0.5 * (block_cells - 1)) / block_cells;
      const double v = (y - 0.5 * (block_cells - 1)) / block_cells;
      change(x, y) = (change(x, y) - sample_bspline(pull, u, v)) * smoothstep(unit(distance / shore_cells));
    }
  });
}

}  // namespace belvedere
