#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace belvedere {

// Limits the number of worker threads while it lives. 0 means all of the machine.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads)
      : control_(tbb::global_control::max_allowed_parallelism,
                 threads > 0 ? static_cast<std::size_t>(threads)
                             : tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)) {}

 private:
  tbb::global_control control_;
};

// A rectangle of pixels, half open: x0 <= x < x1.
struct PixelRect {
  int x0 = 0;
  int y0 = 0;
  int x1 = 0;
  int y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool operator==(const PixelRect&) const = default;
};

// Calls f(y) for every row; each row must write only values of its own.
template <class F>
void parallel_rows(int height, F&& f) {
  tbb::parallel_for(tbb::blocked_range<int>(0, height), [&](const tbb::blocked_range<int>& range) {
    for (int y = range.begin(); y != range.end(); ++y) f(y);
  });
}

// Calls f(PixelRect) for every tile of a fixed grid of tiles; each tile must write only values of its own.
template <class F>
void parallel_tiles(int width, int height, int tile_size, F&& f) {
  const int across = (width + tile_size - 1) / tile_size;
  const int down = (height + tile_size - 1) / tile_size;
  tbb::parallel_for(tbb::blocked_range<int>(0, across * down, 1), [&](const tbb::blocked_range<int>& range) {
    for (int i = range.begin(); i != range.end(); ++i) {
      const int x0 = (i % across) * tile_size;
      const int y0 = (i / across) * tile_size;
      f(PixelRect{x0, y0, std::min(x0 + tile_size, width), std::min(y0 + tile_size, height)});
    }
  });
}

// Sum of f(i) for 0 <= i < count, in double, in an order that no thread count changes: fixed chunks, added in sequence.
template <class F>
double deterministic_sum(std::size_t count, F&& f) {
  constexpr std::size_t chunk = 8192;
  std::vector<double> partial((count + chunk - 1) / chunk, 0.0);
  tbb::parallel_for(std::size_t{0}, partial.size(), [&](std::size_t c) {
    double sum = 0.0;
    for (std::size_t i = c * chunk; i < std::min(count, (c + 1) * chunk); ++i) sum += f(i);
    partial[c] = sum;
  });
  double total = 0.0;
  for (const double p : partial) total += p;
  return total;
}

}  // namespace belvedere
