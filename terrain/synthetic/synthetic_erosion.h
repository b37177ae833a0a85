#pragma once

#include <cstdint>
#include <vector>

#include "base/grid.h"

// Rivers cut made-up terrain. All functions give the same bits for any number of threads.
namespace belvedere::synthetic {

// Where the water goes. Only outlets have no receiver.
struct Drainage {
  std::vector<std::int32_t> receiver;  // index of the cell that takes a cell's water, -1 for outlets
  std::vector<std::int32_t> order;     // all cells, receivers before their donors
};

// Receivers by steepest descent on the surface filled by priority flood (Barnes, Lehman & Mulla 2014) from the outlets;
// diagonal drops are weighed by chance (Fairfield & Leymarie 1991, rho8), fixed for each cell, so that
// valleys do not prefer the eight directions of the grid. Pits in altitude_m are filled up to their spill level.
Drainage find_drainage(Grid<float>& altitude_m, const std::vector<std::int32_t>& outlets, std::uint64_t seed);

// Catchment of each cell, km²; `inflow_km2` (empty or of the grid's size) is what comes from outside.
Grid<float> catchments_km2(const Drainage& drainage, const Grid<float>& inflow_km2, double cell_m);

struct ErosionParameters {
  double cell_m = 30.0;
  double unit_m = 1.0;         // horizontal scale of the landscape: 1 in nature, less for small maps
  float hillslope_km2 = 0.7F;  // at smaller catchments slopes no longer steepen
  float step = 1.F;            // length of the time step
  float steepest = 1.2F;       // greatest slope along the water's way, tan
};

// One time step of uplift and stream-power incision, dz/dt = U - K A^0.6 S, implicit in the slope (Braun & Willett 2013), and a
// limit of slope. At a catchment of 1 km² a wave of incision travels 240 m a step where softness is 1.
void erode(Grid<float>& altitude_m, const Drainage& drainage, const Grid<float>& catchment_km2, const Grid<float>& uplift_m,
           const Grid<float>& softness, const ErosionParameters& parameters);

// Hillslopes creep: z += rate · mean difference to the eight neighbours, isotropic; outlets and the rim stay.
void creep(Grid<float>& altitude_m, float rate);

}  // namespace belvedere::synthetic
