#pragma once

#include <cstdint>
#include <vector>

#include "base/grid.h"

// Drainage of synthetic terrain. All functions give the same bits for any number of threads.
// River erosion of synthetic terrain. All functions give the same bits for any number of threads.

namespace belvedere::synthetic {

// Flow directions. Only outlets have no receiver.
struct Drainage {
  std::vector<std::int32_t>
      receiver;  // index of the cell that receives a cell's water, -1 for outlets
  std::vector<std::int32_t> order;          // all cells, receivers before their donors
  std::vector<std::uint64_t> keys, sorted;  // scratch memory for sorting
};

// Receivers by steepest descent on the surface filled from the outlets, in the order in which a
// priority flood (Barnes, Lehman & Mulla 2014) reaches the cells: lowest first, of equal ones the
// one with the lowest index next to the water. Diagonal drops have random weights (Fairfield &
// Leymarie 1991, rho8), fixed for each cell, so that valleys do not prefer the eight directions of
// the grid. Pits in altitude_m are filled up to their spill level. `memory`: an earlier result
// whose memory is reused; its values are ignored. The system would clear new memory each time.
Drainage find_drainage(Grid<float>& altitude_m, const std::vector<std::int32_t>& outlets,
                       std::uint64_t seed, Drainage memory = {});

// Catchment of each cell, km²; `inflow_km2` (empty or of the grid's size) enters from outside.
Grid<float> catchments_km2(const Drainage& drainage, const Grid<float>& inflow_km2, double cell_m);

struct ErosionParameters {
  double cell_m = 30.0;
  double unit_m = 1.0;  // horizontal scale of the landscape: 1 in nature, less for small maps
  float hillslope_km2 = 0.7F;  // below this catchment slopes no longer steepen
  float step = 1.F;            // length of the time step
  float steepest = 1.2F;       // maximum slope along the flow path, tan
};

// Values needed together in the order of the drainage are stored together.
struct ErosionCell {
  float altitude_m;  // new; infinity if not known yet
  float risen_m;
  float incision;
  float limit_m;  // maximum rise, metres per cell
  std::int32_t receiver;
};

// One time step of uplift and stream-power incision, dz/dt = U - K A^0.6 S, implicit in the slope
// (Braun & Willett 2013), with a limit of slope. At a catchment of 1 km² an incision wave travels
// 240 m per step where softness is 1. `memory`: scratch memory reused from step to step; its values
// are ignored.
void erode(Grid<float>& altitude_m, const Drainage& drainage, const Grid<float>& catchment_km2,
           const Grid<float>& uplift_m, const Grid<float>& softness,
           const ErosionParameters& parameters, Grid<ErosionCell>& memory);

// Hillslope creep: z += rate · mean difference to the eight neighbours, isotropic; outlets and the
// border are fixed.
void creep(Grid<float>& altitude_m, float rate);

}  // namespace belvedere::synthetic
