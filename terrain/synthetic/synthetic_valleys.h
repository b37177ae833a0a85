#pragma once

#include <cstdint>

#include "base/grid.h"
#include "terrain/synthetic/synthetic_erosion.h"

// Effects of ice and gravel on the valleys of synthetic terrain: troughs with flat floors, and
// lakes.
namespace belvedere::synthetic {

struct ValleyParameters {
  double cell_m = 30.0;
  double unit_m = 1.0;        // horizontal scale of the landscape
  float relief_m = 2900.F;    // from the lowest valley to the highest summit
  float smallest_km2 = 0.6F;  // catchments below have no floor
  float flank = 1.F;          // 1: U-shaped troughs; small: only the floors are levelled
  std::uint64_t seed = 1;
};

// Half the width of a valley's floor, m: grows with the catchment, varies along the valley, wide at
// the heads of high valleys (cirques).
float floor_half_width_m(const ValleyParameters& parameters, double x_m, double y_m,
                         float catchment_km2, float altitude_m);

// Lowers the ground to the lower envelope of trough profiles along all rivers. Returns the
// membership of valley floors, 0…1.
Grid<float> carve_valleys(Grid<float>& altitude_m, const Drainage& drainage,
                          const Grid<float>& catchment_km2, const ValleyParameters& parameters);

// Adds moraines across selected valleys; fill_pits then makes lakes behind them.
void dam_valleys(Grid<float>& altitude_m, const Drainage& drainage,
                 const Grid<float>& catchment_km2, const ValleyParameters& parameters);

// After this every cell has a strictly lower neighbour, is part of a lake or lies on the border:
// hollows of min_lake_cells or more become lakes, exactly level, smaller ones are filled with a
// slight slope. Returns 1 in lakes.
Grid<std::uint8_t> fill_pits(Grid<float>& altitude_m, int min_lake_cells);

}  // namespace belvedere::synthetic
