#pragma once

#include <cstdint>

#include "base/memory_limit.h"
#include "base/parallel.h"
#include "base/progress.h"

namespace belvedere {

class Cache;
const Cache& no_cache();  // base/cache/cache.h

// How a job runs: threads, memory, progress and cache. Does not change any bit of the result.
struct Run {
  int threads = 0;  // 0: all of the machine
  std::uint64_t memory_bytes =
      0;             // memory for pictures and rasters; 0: the default of base/memory_limit.h
  int tile_px = 32;  // side of the tiles that threads work on, 8…4096
  Progress& progress = silent_progress();
  const Cache& cache =
      no_cache();  // keeps products that are slow to make and depend on inputs alone
};

// Applies a run's threads and memory to the process while it lives.
class RunLimits {
 public:
  explicit RunLimits(const Run& run) : threads_(run.threads), memory_(run.memory_bytes) {}

 private:
  ThreadLimit threads_;
  MemoryLimit memory_;
};

}  // namespace belvedere
