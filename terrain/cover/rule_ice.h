#pragma once

#include <cstdint>
#include <vector>

#include "base/grid.h"
#include "terrain/cover/rule_ground.h"
#include "terrain/io/dem.h"

// Ice of class rules. Private to them.
namespace belvedere::class_rules {

// Ice that comes into a window of a larger DEM from beyond it.
struct IceEntry {
  std::int32_t cell = 0;  // of the window's grid, in which it arrives
  float km2 = 0.F;        // of snow field that it is the ice of
};

struct RuleIce {
  Grid<float> covered;    // where glaciers lie, 0…1
  Grid<float> km2;        // of snow field, whose ice flows through each cell
  Grid<float> surface_m;  // down which it flows
};

// What falls and melts (`balance`, > 0 where more falls) flows downhill, and ice fills the valleys that it flows through until it has
// melted: tongues. On cells that were halved it flows and melts as on those of the data: in streams that are narrower than a cell.
RuleIce flowing_ice(const Grid<float>& balance, const Dem& dem, const std::vector<IceEntry>& entries = {});

// The ice of the ground around a window that flows over the window's rim.
std::vector<IceEntry> find_ice_entries(const RuleGround& around, const Dem& window);

}  // namespace belvedere::class_rules
