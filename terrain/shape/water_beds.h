#pragma once

#include <cstdint>

#include "base/grid.h"
#include "terrain/io/dem.h"

namespace belvedere {

// A DEM contains only the level of water. Synthetic beds from the banks: below the water they
// continue with the banks' slope and level out with depth.
struct WaterBedParameters {
  double river_width_m = 220.0;  // water that is nowhere wider is a river; > 0
  double deepest_m = 60.0;       // depth at which beds level out, > 0
  double flattest_bank = 0.08;   // minimum rise over run, also for level shores; > 0
  double steepest_bank = 0.60;   // ≥ flattest_bank
};

// For each cell of a DEM; both 0 on land.
struct WaterBeds {
  Grid<float> depth_m;  // of the water, treated as a lake everywhere
  Grid<float> lake;  // 1 on lakes and the sea, 0 on rivers, between where a river flows into a lake
};

// `water`: 1 on water, 0 on land. At distance d from the shore, which is half way between cells of
// water and land, a lake is D (1 - exp(-s d / D)) deep: D the maximum depth, s the slope of the
// bank, the mean over land within 6 cells of the nearest shore. The DEM's altitudes are only read.
// Values depend only on the surroundings within some river widths, so windows of a terrain agree.
WaterBeds make_water_beds(const Grid<std::uint8_t>& water, const Dem& dem,
                          const WaterBedParameters& parameters = {});

}  // namespace belvedere
