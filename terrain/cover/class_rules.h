#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"
#include "terrain/climate/rule_climate.h"
#include "terrain/cover/land_cover.h"
#include "terrain/cover/rule_ground.h"
#include "terrain/cover/rule_program.h"
#include "terrain/cover/towns.h"
#include "terrain/io/dem.h"
#include "terrain/shape/hydrology.h"
#include "terrain/shape/sea.h"

// Ice of class rules. Private to them.

namespace belvedere {

// Inputs of rules besides the terrain.
struct ClassRuleParameters {
  std::vector<std::pair<std::string, double>> settings;  // override the rules' parameters by name
  std::vector<KnownTown> towns;                          // known towns
  bool rivers = true;      // false: none are inferred, for example if a map has them
  SeaParameters sea;       // used if the rules refer to the sea
  std::uint64_t seed = 1;  // of noise and of inferred villages
  RuleClimate climate = alpine_climate();
  std::optional<std::vector<TownSite>> sites =
      {};  // all settlements, if they were found on a larger DEM that contains this one
  Catchments* catchments = nullptr;    // of the DEM, if they are already computed or shared
  const RuleAround* around = nullptr;  // of a window of a larger DEM
  const Dem* whole =
      nullptr;  // … and that DEM in coarser cells: relief_4000 reaches beyond the window
};

// Evaluates the rules on the DEM's grid, removes specks and returns land cover; cells that no layer
// covers take the nearest class. Parameters town_highest_m and floor_highest_m that are 0 are taken
// from the treeline at the centre of the map: 520 and 370 m below it. Rivers are lines besides the
// classes (LandCover::inferred_rivers). Error(usage) for a setting that is not a parameter of the
// rules, with the closest known one. Noise depends only on the seed and the position in the CRS, so
// a part of a DEM gets the same ragged treelines as the whole. `seen`, if given, receives the
// variables, for windows in this ground.
LandCover apply_class_rules(const ClassRules& rules, const ClassRuleParameters& parameters,
                            const Dem& dem, Progress& progress, RuleGround* seen = nullptr);
// Their variables, without the classes.
RuleGround see_rule_ground(const ClassRules& rules, const ClassRuleParameters& parameters,
                           const Dem& dem);

// The settlements used by the rules on a DEM; none if the rules do not use them.
std::vector<TownSite> find_rule_towns(const ClassRules& rules,
                                      const ClassRuleParameters& parameters, const Dem& dem);

// The parameters together with everything that is determined once per map: altitudes that the rules
// leave open, and settlements. With them, parts of the DEM get the same result as the whole.
ClassRuleParameters parameters_for_parts(const ClassRules& rules,
                                         const ClassRuleParameters& parameters, const Dem& whole);

namespace class_rules {

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

}  // namespace class_rules

}  // namespace belvedere
