#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

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

// A lake of a map.
struct KnownLake {
  std::vector<std::vector<glm::dvec2>> rings;  // as of CoverArea (terrain/cover/map_cover.h)
  std::optional<double> level_m;               // of its water; empty: from the ground
  std::string where;                           // for messages
};

// Result for a lake.
struct LakeLevel {
  std::optional<double> level_m;  // empty if no cell's centre lies in it: too small for this ground
  std::size_t cells = 0;
  double bank_share = 0.0;  // of its cells: ground too high for the water, left unchanged
  bool uneven = false;  // the lower half of its ground has more than 15 m of relief: not levelled
  std::optional<double> refused_level_m;  // the map's level, if the ground contradicts it
};

// Levels of lakes on a ground. A lake without a level takes that of the ground in its outline: the
// 30th percentile, so that an outline that extends onto the banks does not raise the water. A map's
// level that differs by more than 40 m is rejected.
std::vector<LakeLevel> find_lake_levels(const Dem& dem, const std::vector<KnownLake>& lakes);

// Levels the water: cells in a lake get its level, but banks more than 25 m above it are unchanged.
// Where lakes overlap, the later one wins.
void level_known_lakes(Dem& dem, const std::vector<KnownLake>& lakes,
                       const std::vector<LakeLevel>& levels);

}  // namespace belvedere
