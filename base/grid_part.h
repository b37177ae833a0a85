#pragma once

#include <algorithm>

#include "base/grid.h"
#include "base/parallel.h"

namespace belvedere {

// The values of a rectangle of a grid, which must lie inside it.
template <class T>
Grid<T> part_of(const Grid<T>& grid, PixelRect rect) {
  Grid<T> part(rect.width(), rect.height());
  parallel_ranges(rect.height(), 64, [&](int begin, int end) {
    for (int y = begin; y != end; ++y) std::copy_n(grid.row(rect.y0 + y) + rect.x0, rect.width(), part.row(y));
  });
  return part;
}

}  // namespace belvedere
