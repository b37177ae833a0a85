#pragma once

#include "base/grid.h"
#include "base/progress.h"

namespace belvedere {

// Stripes run nearly along rows or columns. There are three kinds:
//   offset        whole lines are too high or too low: old profiling instruments (USGS 7.5′ DEMs),
//                 satellite radar (SRTM)
//   displacement  whole lines are shifted along or across themselves, visible only on slopes and
//                 proportional to the slope: a DEM resampled by nearest neighbours into a rotated
//                 CRS
// All are detected and removed by the same regression, see destripe.cpp.
struct DestripeParameters {
  float longest_period_cells = 6.F;  // wider bands are terrain; 3…64
  float length_cells = 160.F;        // over which a stripe is constant along itself; 16…2000
  float max_tilt = 0.3F;             // of stripes against rows and columns, cells per cell; 0…0.5
  // Lines count as stripes if they are this much more coherent in one direction than in the median
  // direction; 1.2…100.
  float min_contrast = 1.5F;
  int max_passes = 6;  // each removes one kind in one direction; 0…20
};

// The DEM without its stripes; bit-identical if none are found. Removals are reported as notes.
// Altitudes must be finite. Directions with fewer than 48 cells are skipped.
Grid<float> destripe(const Grid<float>& altitude_m, const DestripeParameters& parameters,
                     Progress& progress);

}  // namespace belvedere
