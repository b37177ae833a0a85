#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/filter.h"
#include "base/grid.h"
#include "base/parallel.h"

namespace belvedere {

using Mask = Grid<std::uint8_t>;  // 0: not marked

// Marks the cells (4-connected) that can be reached from marked ones through cells where `open` is
// true.
template <class Open>
void flood(Mask& mask, std::vector<std::int32_t> from, Open&& open) {
  const int width = mask.width();
  while (!from.empty()) {
    const std::int32_t at = from.back();
    from.pop_back();
    const int x = at % width;
    const int y = at / width;
    for (const auto& [dx, dy] :
         {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
      if (!mask.contains(x + dx, y + dy) || mask(x + dx, y + dy) != 0 || !open(x + dx, y + dy))
        continue;
      mask(x + dx, y + dy) = 1;
      from.push_back((y + dy) * width + x + dx);
    }
  }
}

// Distance of each cell to the nearest marked one, m; 1 000 000 if there is none.
inline Grid<float> distance_to_marked_m(const Mask& mask, double cell_m) {
  const Grid<std::int32_t> nearest = nearest_marked(mask);
  Grid<float> distance(mask.width(), mask.height());
  parallel_rows(mask.height(), [&](int y) {
    for (int x = 0; x < mask.width(); ++x) {
      const std::int32_t at = nearest(x, y);
      const double dx = at % mask.width() - x;
      const double dy = at / mask.width() - y;
      distance(x, y) = at < 0 ? 1e6F : static_cast<float>(cell_m * std::sqrt(dx * dx + dy * dy));
    }
  });
  return distance;
}

inline bool at_edge(const Mask& mask, int x, int y) {
  return x == 0 || y == 0 || x == mask.width() - 1 || y == mask.height() - 1;
}

// Pieces (4-connected) of the cells marked `wanted`: calls f with the cells of each, in the order
// of the first.
template <class F>
void each_piece(const Mask& mask, std::uint8_t wanted, F&& f) {
  Mask seen(mask.width(), mask.height(), 0);
  std::vector<std::int32_t> cells;
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x) {
      if (mask(x, y) != wanted || seen(x, y) != 0) continue;
      cells.assign(1, y * mask.width() + x);
      seen(x, y) = 1;
      for (std::size_t k = 0; k < cells.size(); ++k) {
        const int cx = cells[k] % mask.width();
        const int cy = cells[k] / mask.width();
        for (const auto& [dx, dy] :
             {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
          if (!mask.contains(cx + dx, cy + dy) || mask(cx + dx, cy + dy) != wanted ||
              seen(cx + dx, cy + dy) != 0)
            continue;
          seen(cx + dx, cy + dy) = 1;
          cells.push_back((cy + dy) * mask.width() + cx + dx);
        }
      }
      f(cells);
    }
}

}  // namespace belvedere
