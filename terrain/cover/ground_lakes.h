#pragma once

#include <cstdint>

#include "base/grid.h"
#include "terrain/io/dem.h"
#include "terrain/shape/hydrology.h"
#include "terrain/shape/sea.h"

namespace belvedere {

// Lakes for class rules and surface layers: level ground, and large voids in the data with a level
// shore, except at sea. 1 on lakes. `parameters`: for the data's cells; on refined cells lakes keep
// their area, down to the smallest patch that is not a speck. `known`: lakes of a larger DEM around
// a window, in the window's cells; else empty.
Grid<std::uint8_t> ground_lakes(const Dem& dem, LakeParameters parameters, const Sea& sea,
                                const Grid<std::uint8_t>& known = {});

// Lakes without altitudes in the data: voids of at least `min_cells` cells with a level shore (the
// lower half of the cells around them within 1 m). 1 in such a lake. A void that touches the border
// is not a lake, except in a window of a larger DEM with `known` lakes, if most of it is known to
// be one.
Grid<std::uint8_t> find_hole_lakes(const Dem& dem, int min_cells = 150,
                                   const Grid<std::uint8_t>& known = {});

}  // namespace belvedere
