#pragma once

#include <cstdint>

#include "terrain/io/dem.h"

namespace belvedere {

// Lakes without altitudes in the data: voids of at least `min_cells` cells with a level shore (the
// lower half of the cells around them within 1 m). 1 in such a lake. A void that touches the border
// is not a lake, except in a window of a larger DEM with `known` lakes, if most of it is known to
// be one.
Grid<std::uint8_t> find_hole_lakes(const Dem& dem, int min_cells = 150,
                                   const Grid<std::uint8_t>& known = {});

}  // namespace belvedere
