#pragma once

#include <cstdint>

#include "base/progress.h"
#include "terrain/io/dem.h"

namespace belvedere {

// A made-up alpine terrain: ridges of warped noise rise and rivers cut them (stream power), ice widens the valleys to troughs with
// flat floors, gravel levels them, moraines hold lakes. A main valley runs through the map from west to east or east to west about
// every 38 km. From every cell the way leads down to the rim or into a lake; a lake is exactly level.
// The same bits for any number of threads.
struct SyntheticParameters {
  int width = 1200;         // cells, 16…16384
  int height = 1400;        // cells, 16…16384
  double cell_m = 30.0;     // 1…1000
  double lowest_m = 500.0;  // altitude of the lowest valley
  // The highest summit comes within 3 % of it, but maps of less than some 20 km a side cannot hold high mountains: their
  // summits stay as low as a mean slope of 33° asks for.
  double highest_m = 3400.0;
  std::uint64_t seed = 1;
};

// Error(usage) naming the parameter out of range. No CRS: the south-west corner lies at (0, 0), in metres.
Dem make_synthetic_terrain(const SyntheticParameters& parameters, Progress& progress);
// Plain ridged fractal noise of any size, cheap: for benchmarks.
Dem make_ridged_noise(const SyntheticParameters& parameters);

}  // namespace belvedere
