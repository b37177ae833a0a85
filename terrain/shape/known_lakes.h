#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "terrain/io/dem.h"

namespace belvedere {

// A lake as a map has it.
struct KnownLake {
  std::vector<std::vector<glm::dvec2>> rings;  // as of CoverArea (terrain/cover/map_cover.h)
  std::optional<double> level_m;               // of its water; empty: the ground's own
  std::string where;                           // for messages
};

// What became of it.
struct LakeLevel {
  std::optional<double> level_m;  // empty where no cell's centre lies in it: too small for this ground
  std::size_t cells = 0;
  double bank_share = 0.0;                // of its cells: ground too high for its water, which stays
  bool uneven = false;                    // the lower half of its ground falls by more than 15 m: nothing is levelled
  std::optional<double> refused_level_m;  // the map's level, where the ground says quite another
};

// Levels of lakes on a ground. Without a level of its own a lake has that of the ground in its outline: what 30 of 100 cells stay below,
// so that an outline that reaches up the banks does not lift the water. A map's level that is more than 40 m off that is none.
std::vector<LakeLevel> find_lake_levels(const Dem& dem, const std::vector<KnownLake>& lakes);

// Makes the water level: cells in a lake get its level, but banks more than 25 m above it stay. Where lakes overlap the later counts.
void level_known_lakes(Dem& dem, const std::vector<KnownLake>& lakes, const std::vector<LakeLevel>& levels);

}  // namespace belvedere
