#pragma once

#include <cstdint>
#include <vector>

#include "base/grid.h"
#include "terrain/cover/rule_ground.h"
#include "terrain/io/dem.h"

// Ice of class rules. Private to them.
namespace belvedere::class_rules {

// Ice that flows into a window of a larger DEM.
struct IceEntry {
  std::int32_t cell = 0;  // of the window's grid, where it enters
  float km2 = 0.F;        // area of snow field it comes from
};

struct RuleIce {
  Grid<float> covered;    // glaciers, 0…1
  Grid<float> km2;        // area of snow field whose ice flows through each cell
  Grid<float> surface_m;  // surface of the ice
};

// Accumulation minus melt (`balance`) flows downhill, and ice fills the valleys it flows through
// until it has melted: tongues. On refined cells it flows and melts as on those of the data, in
// streams narrower than a cell.
RuleIce flowing_ice(const Grid<float>& balance, const Dem& dem,
                    const std::vector<IceEntry>& entries = {});

// The ice of the ground around a window that flows across the window's edge.
std::vector<IceEntry> find_ice_entries(const RuleGround& around, const Dem& window);

}  // namespace belvedere::class_rules
