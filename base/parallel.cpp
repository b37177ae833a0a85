#include "base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "base/memory/sanitized.h"

#ifdef BELVEDERE_THREAD_SANITIZER
#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <thread>
#endif

namespace belvedere {

struct ThreadLimit::Control {
  explicit Control(std::size_t threads)
      : limit(tbb::global_control::max_allowed_parallelism, threads) {}
  tbb::global_control limit;
};

ThreadLimit::ThreadLimit(int threads)
    : control_(new Control(static_cast<std::size_t>(threads > 0 ? threads : max_threads()))) {}

ThreadLimit::~ThreadLimit() { delete control_; }

int max_threads() {
  return static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

#ifdef BELVEDERE_THREAD_SANITIZER
// TBB is not instrumented: the thread sanitizer would report every hand-over between caller and
// task as a race. That build uses two plain threads, whose start and end the sanitizer sees, so
// that it reports only races between tasks.
void run_ranges(std::size_t count, std::size_t grain,
                FunctionRef<void(std::size_t begin, std::size_t end)> f) {
  const std::size_t step = std::max(std::max<std::size_t>(grain, 1), count / 8);
  std::atomic<std::size_t> next{0};
  std::array<std::exception_ptr, 2> failed;
  const auto work = [&](std::size_t who) {
    try {
      for (std::size_t begin = next.fetch_add(step); begin < count; begin = next.fetch_add(step))
        f(begin, std::min(begin + step, count));
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

void isolated(FunctionRef<void()> f) { f(); }
#else
void run_ranges(std::size_t count, std::size_t grain,
                FunctionRef<void(std::size_t begin, std::size_t end)> f) {
  // A context of its own: an exception cancels the loop it leaves. Otherwise loops inside other
  // tasks of that loop would be cancelled without an exception of their own, and their callers
  // would go on with half of the values.
  tbb::task_group_context context(tbb::task_group_context::isolated);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, grain),
      [&](const tbb::blocked_range<std::size_t>& range) { f(range.begin(), range.end()); },
      context);
}

void isolated(FunctionRef<void()> f) {
  tbb::this_task_arena::isolate([&] { f(); });
}
#endif

}  // namespace belvedere
