#pragma once

#include <cstddef>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// A place that is higher than all around it.
struct Summit {
  int x = 0;  // cell
  int y = 0;
  float altitude_m = 0.F;
  // How far one must go down, at least, on the way to higher ground; of the highest summit its height over the lowest cell.
  float prominence_m = 0.F;
};

struct SummitParameters {
  double least_prominence_m = 150.0;  // > 0
  std::size_t most = 10000;           // the most prominent ones
};

// The summits of a DEM, most prominent first, equal ones by row and column. Level summits are one, at their first cell. What is highest at
// the border of the data, or beside a void (NaN), is none: the mountain may go on. Ways go over all eight neighbours. Needs 12 bytes a
// cell.
std::vector<Summit> find_summits(const Grid<float>& altitude_m, const SummitParameters& parameters = {});

}  // namespace belvedere
