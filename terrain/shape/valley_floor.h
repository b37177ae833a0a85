#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/grid.h"
#include "terrain/io/dem.h"

namespace belvedere {

// Criteria of a valley floor: flat, low, and between mountains.
struct ValleyFloorParameters {
  double steepest_deg = 5.5;     // slope after a Gaussian of 60 m
  double above_lowest_m = 70.0;  // maximum height above the lowest ground within 900 m
  double below_highest_m =
      300.0;  // minimum depth below the highest ground within 3 km: a plain is not a valley
};

// 1 on valley floors. Void (NaN) cells are 0.
Grid<std::uint8_t> find_valley_floor(const Grid<float>& altitude_m, double cell_m,
                                     const ValleyFloorParameters& parameters = {});

// A window of a larger terrain with the ground around it, for quantities with a long reach:
// shadows, wide means.
struct Surrounded {
  Grid<float> altitude_m;
  GeoTransform transform;
  int left = 0, top = 0;  // the window's first cell
};

// `own`: altitudes of the window's cells, or of blocks of them, at `transform`. Around them, up to
// `reach_m` if available, lies the whole's ground, interpolated bilinearly.
Surrounded surround(const Grid<float>& own, const GeoTransform& transform, const Dem& whole,
                    double reach_m);

// A position that is higher than everything around it.
struct Summit {
  int x = 0;  // cell
  int y = 0;
  float altitude_m = 0.F;
  // Prominence: the minimum descent on the way to higher ground; for the highest summit its height
  // above the lowest cell.
  float prominence_m = 0.F;
};

struct SummitParameters {
  double min_prominence_m = 150.0;  // > 0
  std::size_t max = 10000;          // number of summits, the most prominent ones
};

// The summits of a DEM, most prominent first, equal ones by row and column. A level summit counts
// once, at its first cell. A maximum at the border of the data, or next to a void (NaN), is not a
// summit, because the mountain may continue. Paths use all eight neighbours. Needs 12 bytes per
// cell.
std::vector<Summit> find_summits(const Grid<float>& altitude_m,
                                 const SummitParameters& parameters = {});

}  // namespace belvedere
