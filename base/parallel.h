#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#if defined(__SANITIZE_THREAD__)
#include <array>
#include <atomic>
#include <exception>
#include <thread>
#endif

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
  bool empty() const { return x1 <= x0 || y1 <= y0; }
  bool operator==(const PixelRect&) const = default;
};
inline PixelRect intersection(const PixelRect& a, const PixelRect& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}
// A rectangle and what lies within `margin` of it.
inline PixelRect grown(const PixelRect& rect, int margin) {
  return {rect.x0 - margin, rect.y0 - margin, rect.x1 + margin, rect.y1 + margin};
}
inline PixelRect moved(const PixelRect& rect, int x, int y) { return {rect.x0 + x, rect.y0 + y, rect.x1 + x, rect.y1 + y}; }

// Calls f(begin, end) for ranges that cover 0 <= i < count, none split that is `grain` or shorter; each must write only values of its own.
#if defined(__SANITIZE_THREAD__)
// TBB is not instrumented: the thread sanitizer would take every hand-over between caller and task for a race. In that build two plain
// threads, whose start and end it knows, share the ranges, so that a race of two tasks is found and nothing else.
template <class Index, class F>
void parallel_ranges(Index count, Index grain, F&& f) {
  const Index step = std::max<Index>(std::max<Index>(grain, 1), count / 8);
  std::atomic<Index> next{0};
  std::array<std::exception_ptr, 2> failed;
  const auto work = [&](std::size_t who) {
    try {
      for (Index begin = next.fetch_add(step); begin < count; begin = next.fetch_add(step)) f(begin, std::min<Index>(begin + step, count));
    } catch (...) {
      failed[who] = std::current_exception();
    }
  };
  std::thread other(work, 1);
  work(0);
  other.join();
  for (const std::exception_ptr& fault : failed)
    if (fault) std::rethrow_exception(fault);
}
#else
template <class Index, class F>
void parallel_ranges(Index count, Index grain, F&& f) {
  tbb::parallel_for(tbb::blocked_range<Index>(0, count, grain),
                    [&](const tbb::blocked_range<Index>& range) { f(range.begin(), range.end()); });
}
#endif

// Calls f(), in which a thread that waits for others takes up no work from outside: so its caller may hold a lock.
template <class F>
void isolated(F&& f) {
#if defined(__SANITIZE_THREAD__)
  f();
#else
  tbb::this_task_arena::isolate(f);
#endif
}

// Calls f(y) for every row; each row must write only values of its own.
template <class F>
void parallel_rows(int height, F&& f) {
  parallel_ranges(height, 1, [&](int begin, int end) {
    for (int y = begin; y != end; ++y) f(y);
  });
}

// Calls f(PixelRect) for every tile of a fixed grid of tiles; each tile must write only values of its own.
template <class F>
void parallel_tiles(int width, int height, int tile_size, F&& f) {
  const int across = (width + tile_size - 1) / tile_size;
  const int down = (height + tile_size - 1) / tile_size;
  parallel_ranges(across * down, 1, [&](int begin, int end) {
    for (int i = begin; i != end; ++i) {
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
  parallel_ranges(partial.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c != end; ++c) {
      double sum = 0.0;
      for (std::size_t i = c * chunk; i < std::min(count, (c + 1) * chunk); ++i) sum += f(i);
      partial[c] = sum;
    }
  });
  double total = 0.0;
  for (const double p : partial) total += p;
  return total;
}

}  // namespace belvedere
