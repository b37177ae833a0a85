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
    for (int y = begin; y != end; ++y)
      std::copy_n(grid.row(rect.y0 + y) + rect.x0, rect.width(), part.row(y));
  });
  return part;
}

// Copies a grid to where column x0 and row y0 of another begin; it must lie inside.
template <class T>
void copy_part(Grid<T>& whole, const Grid<T>& part, int x0, int y0) {
  parallel_ranges(part.height(), 64, [&](int begin, int end) {
    for (int y = begin; y != end; ++y)
      std::copy_n(part.row(y), part.width(), whole.row(y0 + y) + x0);
  });
}

}  // namespace belvedere
