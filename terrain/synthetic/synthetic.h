#pragma once

#include <cstdint>

#include "base/progress.h"
#include "terrain/io/dem.h"

namespace belvedere {

// Synthetic alpine terrain: ridges of warped noise rise and are cut by rivers (stream power),
// glaciers widen the valleys to troughs with flat floors, gravel levels them, moraines dam lakes. A
// main valley crosses the map from west to east or east to west about every 38 km. From every cell
// a path leads down to the border or into a lake; lakes are exactly level. The same bits for any
// number of threads.
struct SyntheticParameters {
  int width = 1200;         // cells, 16…16384
  int height = 1400;        // cells, 16…16384
  double cell_m = 30.0;     // 1…1000
  double lowest_m = 500.0;  // altitude of the lowest valley
  // The highest summit is within 3 % of it, but maps of less than some 20 km a side cannot hold
  // high mountains: their summits are limited by a mean slope of 33°.
  double highest_m = 3400.0;
  std::uint64_t seed = 1;
};

// Error(usage) with the parameter out of range. No CRS: the south-west corner lies at (0, 0), in
// metres.
Dem make_synthetic_terrain(const SyntheticParameters& parameters, Progress& progress);
// Plain ridged fractal noise of any size, fast: for benchmarks.
Dem make_ridged_noise(const SyntheticParameters& parameters);

}  // namespace belvedere
