#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/grid.h"
#include "terrain/io/dem.h"

namespace belvedere {

// Catchment area of every cell, km², including the cell itself. A flood from the border
// (spill_level.h) fills hollows up to their outlet, so that every cell drains; then each cell flows
// to the neighbour of steepest descent (D8), through filled hollows along their deepest line, and
// across flats along their middle. Values grow strictly downstream, so they also give the flow
// direction. Ground outside the grid is unknown: a river that enters at the border begins there,
// unless it is among the entries, whose areas count as whole cells. Cells finite; fewer than 2^31
// cells.
Grid<float> flow_accumulation_km2(const Grid<float>& altitude_m, double cell_m,
                                  const std::vector<RiverEntry>& entries = {});

// Altitudes with every hollow filled up to its outlet by the same flood; the difference is the
// depth of pits.
Grid<float> fill_hollows(const Grid<float>& altitude_m);

struct LakeParameters {
  float max_range_m = 0.25F;  // maximum range of altitude in a lake's 3×3 neighbourhood
  int min_cells = 150;
  // Minimum mean height of the ground on a ring seven cells away above the lake, each cell clamped
  // to -2…2 m. With altitudes in whole metres, a flood plain consists of flat steps as large as
  // lakes, but lower ground is as frequent around them as higher: they reach .9 m, real lakes at
  // least 1.2 m. 0 or less accepts them.
  float min_bank_m = 1.1F;
};
// 1 where water stands, 0 elsewhere: cells whose 3×3 neighbourhood is flat, after two openings
// (which remove thin and small flats), in pieces (4-connected) of at least min_cells with banks,
// each grown to its shore, the last cells at the lake's level.
Grid<std::uint8_t> find_lakes(const Grid<float>& altitude_m, const LakeParameters& parameters);

// Coverage of each cell by rivers, 0…1. The half-width grows with the catchment, 18 m · (area / 110
// km²)^.458: 18 m at 110 km², 36 m at 500 km², at most 90 m. This is about twice the real width, as
// on maps; from 75 to 110 km² a stream fades in. On cells too coarse to show that, it is up to 5/3
// as wide. Centrelines run downstream through the cells of flow_accumulation_km2 and are smoothed
// by 3.5 cells to remove the stairs of the grid.
Grid<float> river_mask(const Grid<float>& catchment_km2, double cell_m);
// The half-width itself, m; 0 below 75 km².
double river_half_width_m(double catchment_km2);

// Catchment areas of a DEM, computed on first use and kept, because class rules and the terrain
// model both need them and drainage runs on one thread. The DEM must outlive it. Not thread-safe.
class Catchments {
 public:
  explicit Catchments(const Dem& dem) : dem_(dem) {}
  // Whether km2() was computed.
  Catchments(const Dem& dem, Grid<float> km2) : dem_(dem), km2_(std::move(km2)) {}
  Catchments(const Catchments&) = delete;
  Catchments& operator=(const Catchments&) = delete;

  // flow_accumulation_km2() of the DEM with its entries.
  const Grid<float>& km2();
  // The same for the last caller; releases it.
  Grid<float> take_km2();

 private:
  const Dem& dem_;
  Grid<float> km2_;
};

}  // namespace belvedere
