#pragma once

#include <algorithm>
#include <vector>

#include "base/grid.h"
#include "base/parallel.h"

namespace belvedere {

// The smallest rectangle that contains all pixels of `in` that pass a test; empty where none does.
template <class Test>
PixelRect extent_of(PixelRect in, Test&& test) {
  if (in.empty()) return {in.x1, in.y1, in.x0, in.y0};
  struct Span {
    int first;
    int end;
  };
  std::vector<Span> spans(static_cast<std::size_t>(in.height()), Span{in.x1, in.x0});
  parallel_ranges(in.height(), 16, [&](int begin, int end) {
    for (int row = begin; row != end; ++row) {
      Span& span = spans[static_cast<std::size_t>(row)];
      const int y = in.y0 + row;
      int x = in.x0;
      while (x < in.x1 && !test(x, y)) ++x;
      if (x == in.x1) continue;
      span.first = x;
      x = in.x1 - 1;
      while (!test(x, y)) --x;
      span.end = x + 1;
    }
  });
  PixelRect extent{in.x1, in.y1, in.x0, in.y0};
  for (int row = 0; row < in.height(); ++row) {
    const Span& span = spans[static_cast<std::size_t>(row)];
    if (span.end <= span.first) continue;
    extent = {std::min(extent.x0, span.first), std::min(extent.y0, in.y0 + row),
              std::max(extent.x1, span.end), in.y0 + row + 1};
  }
  return extent;
}

// Whether a neighbour above, below or beside holds another value: one pixel of two planes.
template <class T>
bool is_edge(const Grid<T>& planes, int x, int y) {
  const T own = planes(x, y);
  return (x > 0 && planes(x - 1, y) != own) ||
         (x + 1 < planes.width() && planes(x + 1, y) != own) ||
         (y > 0 && planes(x, y - 1) != own) || (y + 1 < planes.height() && planes(x, y + 1) != own);
}

}  // namespace belvedere
