#pragma once

#include "base/grid.h"
#include "base/progress.h"

namespace belvedere {

// Stripes run nearly along rows or columns, and are of three kinds, told apart by what they follow:
//   offset        whole lines stand too high or too low: old profiling instruments (USGS 7.5′ DEMs), satellite radar (SRTM)
//   displacement  whole lines were moved, along themselves or across, so that they show on slopes only, as strong as the slope there:
//                 a DEM resampled by nearest neighbours into a CRS turned against its own
// Both are found and removed by the same regression, see destripe.cpp.
struct DestripeParameters {
  float longest_period_cells = 6.F;  // wider bands are taken for terrain; 3…64
  float length_cells = 160.F;        // over which a stripe is taken to be the same, along itself; 16…2000
  float most_tilt = 0.3F;            // of stripes against rows and columns, cells per cell; 0…0.5
  // How much more coherent lines must be in one direction than in the middle of all before they pass for stripes; 1.2…100.
  float least_contrast = 1.5F;
  int most_passes = 6;  // each removes one kind in one direction; 0…20
};

// The DEM without its stripes; bit for bit itself where none are found. `note` of progress tells what was removed. Altitudes finite;
// grids smaller than 48 cells in a direction are left alone in it.
Grid<float> destripe(const Grid<float>& altitude_m, const DestripeParameters& parameters, Progress& progress);

}  // namespace belvedere
