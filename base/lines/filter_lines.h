#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "base/grid.h"
#include "base/parallel.h"

namespace belvedere {

// For separable filters: sixteen neighbouring rows or columns interleaved, element i of all of them
// in one cache line. One filter then works for both directions, and the compiler vectorizes its
// inner loop over the lanes.
class LineBundle {
 public:
  static constexpr int lanes = 16;
  explicit LineBundle(int count)
      : count_(count), values_(static_cast<std::size_t>(count) * lanes) {}
  int count() const { return count_; }
  // The sixteen values of element i.
  float* operator[](int i) { return values_.data() + static_cast<std::ptrdiff_t>(i) * lanes; }
  const float* operator[](int i) const {
    return values_.data() + static_cast<std::ptrdiff_t>(i) * lanes;
  }

 private:
  int count_;
  std::vector<float> values_;
};

// The lines with `before` copies of their first and `after` copies of their last element.
inline LineBundle replicate_ends(const LineBundle& lines, int before, int after) {
  LineBundle out(before + lines.count() + after);
  const int last = lines.count() - 1;
  for (int i = 0; i < before; ++i) std::copy_n(lines[0], LineBundle::lanes, out[i]);
  std::copy_n(lines[0], static_cast<std::ptrdiff_t>(lines.count()) * LineBundle::lanes,
              out[before]);
  for (int i = 0; i < after; ++i)
    std::copy_n(lines[last], LineBundle::lanes, out[before + lines.count() + i]);
  return out;
}

// Replaces every row by filter(LineBundle), which must keep the count. Spare lanes repeat the last
// row.
template <class F>
void transform_rows(Grid<float>& values, F&& filter) {
  constexpr int n = LineBundle::lanes;
  const int height = values.height();
  parallel_rows((height + n - 1) / n, [&](int bundle) {
    const int first = bundle * n;
    LineBundle lines(values.width());
    for (int l = 0; l < n; ++l) {
      const float* row = values.row(std::min(first + l, height - 1));
      for (int x = 0; x < values.width(); ++x) lines[x][l] = row[x];
    }
    const LineBundle filtered = filter(lines);
    for (int l = 0; l < std::min(n, height - first); ++l) {
      float* row = values.row(first + l);
      for (int x = 0; x < values.width(); ++x) row[x] = filtered[x][l];
    }
  });
}

// The same for columns.
template <class F>
void transform_columns(Grid<float>& values, F&& filter) {
  constexpr int n = LineBundle::lanes;
  const int width = values.width();
  parallel_rows((width + n - 1) / n, [&](int bundle) {
    const int first = bundle * n;
    const int used = std::min(n, width - first);
    LineBundle lines(values.height());
    for (int y = 0; y < values.height(); ++y) {
      const float* row = values.row(y) + first;
      std::copy_n(row, used, lines[y]);
      std::fill(lines[y] + used, lines[y] + n, row[used - 1]);
    }
    const LineBundle filtered = filter(lines);
    for (int y = 0; y < values.height(); ++y) std::copy_n(filtered[y], used, values.row(y) + first);
  });
}

}  // namespace belvedere
