#pragma once

#include <cstddef>

#include "terrain/io/dem.h"

namespace belvedere {

// A DEM whose cells are the highest of n × n, n the smallest that leaves at most so many cells: the
// skyline keeps its summits.
Dem highest_cells(const Dem& dem, std::size_t max_cells);

}  // namespace belvedere
