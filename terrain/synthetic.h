#pragma once

#include <cstdint>

#include "renderer/base/progress.h"
#include "terrain/dem.h"

namespace belvedere {

// A made-up alpine terrain: ridged noise, uplifted and cut by rivers (stream power), thermal and hydraulic erosion, flat
// valley floors, lakes in hollows. Deterministic for any number of threads.
struct SyntheticParameters {
  int width = 1200;         // cells, 16…16384
  int height = 1400;        // cells, 16…16384
  double cell_m = 30.0;     // 1…1000
  double lowest_m = 500.0;  // altitude of the lowest valley
  double highest_m = 3400.0;
  std::uint64_t seed = 1;
};

Dem make_synthetic_terrain(const SyntheticParameters& parameters, Progress& progress);
// Plain ridged fractal noise of any size, cheap: for benchmarks.
Dem make_ridged_noise(const SyntheticParameters& parameters);

}  // namespace belvedere
