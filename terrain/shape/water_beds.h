#pragma once

#include <cstdint>

#include "base/grid.h"
#include "terrain/io/dem.h"

namespace belvedere {

// A DEM knows the level of water alone. Beds made up from the banks: they go on below the water as steeply as they rise from it, and level
// out in the deep.
struct WaterBedParameters {
  double river_width_m = 220.0;  // water that is nowhere wider is a river or a brook; > 0
  double deepest_m = 60.0;       // what beds level out at, > 0
  double flattest_bank = 0.08;   // rise over run; level shores still fall off below the water; > 0
  double steepest_bank = 0.60;   // ≥ flattest_bank
};

// Of each cell of a DEM; both 0 on land.
struct WaterBeds {
  Grid<float> depth_m;  // of the water, as if all of it were a lake
  Grid<float> lake;     // 1 on lakes and the sea, 0 on rivers, between them where a river runs out into a lake
};

// `water`: 1 on water, 0 on land. At d from the shore, which lies half way between cells of water and land, a lake is D (1 - exp(-s d / D))
// deep: D the deepest, s the rise of the bank over its run, the mean over land within 6 cells of the nearest shore. The DEM's altitudes are
// read, and stay. Values hang on what lies within some river widths alone, so windows of a terrain agree.
WaterBeds make_water_beds(const Grid<std::uint8_t>& water, const Dem& dem, const WaterBedParameters& parameters = {});

}  // namespace belvedere
