#pragma once

#include <cstdint>

#include "base/grid.h"
#include "terrain/io/dem.h"
#include "terrain/shape/hydrology.h"
#include "terrain/shape/sea.h"

namespace belvedere {

// Lakes as class rules and surface layers know them: level ground, and large holes in the data with a level shore, not at sea. 1 on lakes.
// `parameters`: of the data's cells; on cells that were halved lakes are as large, down to what still is a patch and no speck. `known`: of
// a window of a larger DEM, where that has lakes, in the window's cells; else empty.
Grid<std::uint8_t> ground_lakes(const Dem& dem, LakeParameters parameters, const Sea& sea, const Grid<std::uint8_t>& known = {});

}  // namespace belvedere
