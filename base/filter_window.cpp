// Minimum, maximum and nearest-mark filters: exact, at a cost that does not depend on the radius.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/filter.h"
#include "base/lines/filter_lines.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

// van Herk & Gil-Werman: running extremes from each block's start and to each block's end; a window
// as long as a block spans two.
template <class Pick>
LineBundle window_extreme(const LineBundle& lines, int radius, Pick pick) {
  constexpr int n = LineBundle::lanes;
  const int window = 2 * radius + 1;
  const LineBundle padded = replicate_ends(lines, radius, radius);
  LineBundle from_start = padded;
  LineBundle to_end = padded;
  for (int i = 1; i < padded.count(); ++i) {
    if (i % window == 0) continue;
    for (int l = 0; l < n; ++l) from_start[i][l] = pick(from_start[i - 1][l], from_start[i][l]);
  }
  for (int i = padded.count() - 2; i >= 0; --i) {
    if ((i + 1) % window == 0) continue;
    for (int l = 0; l < n; ++l) to_end[i][l] = pick(to_end[i + 1][l], to_end[i][l]);
  }
  LineBundle out(lines.count());
  for (int i = 0; i < lines.count(); ++i) {
    for (int l = 0; l < n; ++l) out[i][l] = pick(to_end[i][l], from_start[i + window - 1][l]);
  }
  return out;
}

template <class Pick>
Grid<float> filter_window(const Grid<float>& values, int radius, Pick pick) {
  Grid<float> out = values;
  if (values.empty() || radius <= 0) return out;
  const int radius_x = std::min(radius, values.width() - 1);
  const int radius_y = std::min(radius, values.height() - 1);
  transform_rows(out,
                 [&](const LineBundle& lines) { return window_extreme(lines, radius_x, pick); });
  transform_columns(out,
                    [&](const LineBundle& lines) { return window_extreme(lines, radius_y, pick); });
  return out;
}

// Row of the nearest mark within each column, -1 if the column has none; ties go to the upper one.
Grid<std::int32_t> nearest_in_columns(const Grid<std::uint8_t>& mask) {
  const int width = mask.width();
  const int height = mask.height();
  Grid<std::int32_t> nearest(width, height, -1);
  parallel_tiles(width, 1, 64, [&](PixelRect columns) {
    for (int y = 0; y < height; ++y) {
      for (int x = columns.x0; x < columns.x1; ++x) {
        if (mask(x, y) != 0) {
          nearest(x, y) = y;
        } else if (y > 0) {
          nearest(x, y) = nearest(x, y - 1);
        }
      }
    }
    std::vector<std::int32_t> below(static_cast<std::size_t>(columns.width()), -1);
    for (int y = height - 1; y >= 0; --y) {
      for (int x = columns.x0; x < columns.x1; ++x) {
        std::int32_t& lower = below[static_cast<std::size_t>(x - columns.x0)];
        if (mask(x, y) != 0) lower = y;
        const std::int32_t upper = nearest(x, y);
        if (lower >= 0 && (upper < 0 || lower - y < y - upper)) nearest(x, y) = lower;
      }
    }
  });
  return nearest;
}

// The mark of one column as a parabola of the squared distance along the row.
struct Parabola {
  std::int64_t x;
  std::int64_t mark_y;
  std::int64_t height;  // squared distance to the row
  std::int64_t from;    // first x of the row at which it is the nearest
};

// Last x at which the left parabola is preferred to the right one: nearer, or equally near with the
// lower index. Two parabolas of one shape cross once, so the preference changes once along the row,
// ties included.
std::int64_t last_preferred(const Parabola& left, const Parabola& right) {
  const std::int64_t numerator = right.x * right.x + right.height - left.x * left.x - left.height;
  const std::int64_t denominator = 2 * (right.x - left.x);
  std::int64_t quotient = numerator / denominator;
  if (numerator % denominator < 0) --quotient;  // floor
  const bool tie = quotient * denominator == numerator;
  const bool left_is_lower =
      left.mark_y <= right.mark_y;  // in the same row left.x < right.x decides
  return tie && !left_is_lower ? quotient - 1 : quotient;
}

}  // namespace

Grid<float> window_minimum(const Grid<float>& values, int radius) {
  return filter_window(values, radius, [](float a, float b) { return b < a ? b : a; });
}

Grid<float> window_maximum(const Grid<float>& values, int radius) {
  return filter_window(values, radius, [](float a, float b) { return b > a ? b : a; });
}

Grid<std::int32_t> nearest_marked(const Grid<std::uint8_t>& mask) {
  const int width = mask.width();
  Grid<std::int32_t> nearest = nearest_in_columns(mask);
  parallel_rows(mask.height(), [&](int y) {
    std::vector<Parabola> envelope;
    envelope.reserve(static_cast<std::size_t>(width));
    std::int32_t* row = nearest.row(y);
    for (int x = 0; x < width; ++x) {
      if (row[x] < 0) continue;
      const std::int64_t dy = row[x] - y;
      Parabola next{x, row[x], dy * dy, std::numeric_limits<std::int64_t>::min()};
      while (!envelope.empty()) {
        const std::int64_t last = last_preferred(envelope.back(), next);
        if (last >= envelope.back().from) {
          next.from = last + 1;
          break;
        }
        envelope.pop_back();
      }
      envelope.push_back(next);
    }
    if (envelope.empty()) return;  // no mark anywhere: all -1
    std::size_t current = 0;
    for (int x = 0; x < width; ++x) {
      while (current + 1 < envelope.size() && envelope[current + 1].from <= x) ++current;
      row[x] = static_cast<std::int32_t>(envelope[current].mark_y * width + envelope[current].x);
    }
  });
  return nearest;
}

}  // namespace belvedere
