#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include "base/pixel_rect.h"

namespace belvedere {

template <class Signature>
class FunctionRef;

// A reference to a callable object, for parameters of functions that call it before they return. It
// does not own the object and, in contrast to std::function, copies and allocates nothing.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
 public:
  template <class F>
  requires(!std::is_same_v<std::remove_cvref_t<F>, FunctionRef>)
      FunctionRef(F&& f)  // NOLINT(google-explicit-constructor): lambdas are passed as they stand
      : object_(const_cast<void*>(static_cast<const void*>(&f))),
        call_([](void* object, Arguments... arguments) -> Result {
          return (*static_cast<std::remove_reference_t<F>*>(object))(arguments...);
        }) {}

  Result operator()(Arguments... arguments) const { return call_(object_, arguments...); }

 private:
  void* object_;
  Result (*call_)(void*, Arguments...);
};

// Limits the number of worker threads while it lives. 0 means all processors of the machine.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;
  ~ThreadLimit();

 private:
  struct Control;
  Control* control_;  // owned; a pointer, so that this header need not include <memory>
};

// The maximum number of threads that work at the same time: that of the machine, or the lowest
// ThreadLimit in effect.
int max_threads();

// Calls f(begin, end) for ranges that cover 0 <= i < count. Ranges of `grain` or less are not
// split. Each call must write only values of its own. f is called once per range through a pointer,
// so put the loop over the range into f, where the compiler can optimize it. An exception ends this
// loop and is thrown to the caller; loops inside other tasks run to their end.
void run_ranges(std::size_t count, std::size_t grain,
                FunctionRef<void(std::size_t begin, std::size_t end)> f);

// Calls f(). A thread that waits for others inside it takes up no other work, so the caller may
// hold a lock.
void isolated(FunctionRef<void()> f);

// run_ranges with indices of any type; a negative count is treated as 0.
template <class Index, class F>
void parallel_ranges(Index count, Index grain, F&& f) {
  if (!(Index{0} < count)) return;
  run_ranges(static_cast<std::size_t>(count),
             grain > Index{1} ? static_cast<std::size_t>(grain) : std::size_t{1},
             [&](std::size_t begin, std::size_t end) {
               f(static_cast<Index>(begin), static_cast<Index>(end));
             });
}

// Calls f(y) for every row; each row must write only values of its own.
template <class F>
void parallel_rows(int height, F&& f) {
  parallel_ranges(height, 1, [&](int begin, int end) {
    for (int y = begin; y != end; ++y) f(y);
  });
}

// Calls f(PixelRect) for every tile of a fixed grid of tiles; each tile must write only values of
// its own.
template <class F>
void parallel_tiles(int width, int height, int tile_size, F&& f) {
  const int across = (width + tile_size - 1) / tile_size;
  const int down = (height + tile_size - 1) / tile_size;
  parallel_ranges(across * down, 1, [&](int begin, int end) {
    for (int i = begin; i != end; ++i) {
      const int x0 = (i % across) * tile_size;
      const int y0 = (i / across) * tile_size;
      f(intersection({x0, y0, x0 + tile_size, y0 + tile_size}, {0, 0, width, height}));
    }
  });
}

// Sum of f(i) for 0 <= i < count, in double, in an order that does not depend on the thread count:
// fixed chunks, added in sequence.
template <class F>
double deterministic_sum(std::size_t count, F&& f) {
  constexpr std::size_t chunk = 8192;
  std::vector<double> partial((count + chunk - 1) / chunk, 0.0);
  parallel_ranges(partial.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c != end; ++c) {
      const std::size_t last = (c + 1) * chunk < count ? (c + 1) * chunk : count;
      double sum = 0.0;
      for (std::size_t i = c * chunk; i < last; ++i) sum += f(i);
      partial[c] = sum;
    }
  });
  double total = 0.0;
  for (const double p : partial) total += p;
  return total;
}

}  // namespace belvedere
