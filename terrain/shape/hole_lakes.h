#pragma once

#include <cstdint>

#include "terrain/io/dem.h"

namespace belvedere {

// Lakes that the data have no altitudes of: holes of at least `least_cells` whose shore is level (the lower half of the cells around them
// within 1 m). 1 in such a lake. A hole that reaches over the rim is none, but for windows of a larger DEM, which has `known` lakes: there
// it is one where most of it is known for one.
Grid<std::uint8_t> find_hole_lakes(const Dem& dem, int least_cells = 150, const Grid<std::uint8_t>& known = {});

}  // namespace belvedere
