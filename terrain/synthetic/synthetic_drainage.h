#pragma once

#include <cstdint>
#include <vector>

#include "base/grid.h"

// Drainage of synthetic terrain. All functions give the same bits for any number of threads.
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

}  // namespace belvedere::synthetic
