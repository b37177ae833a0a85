#pragma once

#include <cstddef>
#include <vector>

#include "base/grid.h"

namespace belvedere {

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
