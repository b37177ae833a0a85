#pragma once

#include <cstdint>

#include <vector>

#include "base/grid.h"
#include "terrain/io/dem.h"

namespace belvedere {

// Catchment area of every cell, km², its own cell included. A flood from the rim (spill_level.h) fills hollows
// up to their outlet, so that every cell drains; then each cell flows to the neighbour of steepest descent (D8), and across
// filled hollows and flats back along the flood. Values grow strictly downstream, so they also say which way water runs.
// What lies outside the grid is unknown: a river that enters at the rim begins there, unless it is among the entries, whose areas count as
// whole cells. Cells finite; fewer than 2^31 cells.
Grid<float> flow_accumulation_km2(const Grid<float>& altitude_m, double cell_m, const std::vector<RiverEntry>& entries = {});

// Altitudes with every hollow filled up to its outlet by the same flood; what it adds is the depth of pits.
Grid<float> fill_hollows(const Grid<float>& altitude_m);

struct LakeParameters {
  float max_range_m = 0.25F;  // a lake's 3×3 neighbourhood differs by less
  int min_cells = 150;
  // How far the ground must rise around, on the mean of a ring seven cells off, each cell counted as -2…2 m. Where altitudes
  // come in whole metres, a flood plain is a flight of flat steps, as large as lakes, but as often lower ground lies beside
  // them as higher: they reach .9 m, real lakes 1.2 m and more. 0 and less admit them.
  float min_bank_m = 1.1F;
};
// 1 where water stands, 0 elsewhere: cells whose 3×3 neighbourhood is flat, opened twice (thin and small flats go), in pieces
// (4-connected) of min_cells or more with banks, each grown to its shore, the last cells at the lake's level.
Grid<std::uint8_t> find_lakes(const Grid<float>& altitude_m, const LakeParameters& parameters);

// How much of each cell a river covers, 0…1. The half-width grows with the catchment, 18 m · (area / 110 km²)^.458: 18 m at
// 110 km², 36 m at 500 km², at most 90 m: some twice what nature has, as maps draw rivers; from 75 to 110 km² a stream comes up from
// nothing. On cells too coarse to show that it is up to 5/3 as wide. Centre lines run through the cells
// of flow_accumulation_km2 downstream and are smoothed by 3.5 cells, so that no stairs of the grid remain.
Grid<float> river_mask(const Grid<float>& catchment_km2, double cell_m);
// The half-width itself, m; 0 below 75 km².
double river_half_width_m(double catchment_km2);

}  // namespace belvedere
