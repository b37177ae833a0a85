#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/progress.h"
#include "terrain/climate/rule_climate.h"
#include "terrain/cover/land_cover.h"
#include "terrain/cover/rule_ground.h"
#include "terrain/cover/rule_program.h"
#include "terrain/cover/towns.h"
#include "terrain/io/dem.h"
#include "terrain/shape/catchments.h"
#include "terrain/shape/sea.h"

namespace belvedere {

// What rules are given besides the terrain.
struct ClassRuleParameters {
  std::vector<std::pair<std::string, double>> settings;  // override the rules' parameters by name
  std::vector<KnownTown> towns;                          // where people are known to live
  bool rivers = true;                                    // false: none are guessed, as where a map has them
  SeaParameters sea;                                     // where rules speak of it
  std::uint64_t seed = 1;                                // of noise and of the villages that are found
  RuleClimate climate = alpine_climate();
  std::optional<std::vector<TownSite>> sites = {};  // all settlements, where they were found on a larger DEM that this one is part of
  Catchments* catchments = nullptr;                 // of the DEM, where somebody else asks for them as well
  const RuleAround* around = nullptr;               // of a window of a larger DEM
  const Dem* whole = nullptr;                       // … and that DEM in its coarser cells: relief_4000 reaches beyond the window
};

// Parameters town_highest_m and floor_highest_m that are 0 hang on the treeline in the middle of the map: 520 and 370 m below it.
// Evaluates the rules on the DEM's grid, cleans up specks, and returns land cover; cells that no layer covers take the nearest class.
// Rivers are lines of their own beside the classes (LandCover::guessed_rivers), where the rules say where they run.
// Error(usage) for a setting that is no parameter of the rules, with the nearest known.
// Noise depends on the seed and the place in the CRS alone, so a part of a DEM gets the same ragged treelines as the whole.
// `seen` gets what the rules saw, where it is given: for the windows in this ground.
LandCover apply_class_rules(const ClassRules& rules, const ClassRuleParameters& parameters, const Dem& dem, Progress& progress,
                            RuleGround* seen = nullptr);
// What they see, without the classes.
RuleGround see_rule_ground(const ClassRules& rules, const ClassRuleParameters& parameters, const Dem& dem);

// The settlements that the rules see on a DEM; none where they ask for none.
std::vector<TownSite> find_rule_towns(const ClassRules& rules, const ClassRuleParameters& parameters, const Dem& dem);

// The parameters with all that is found once on a map: altitudes that the rules leave open, and settlements. With them, parts of the DEM
// are given what the whole is given.
ClassRuleParameters parameters_for_parts(const ClassRules& rules, const ClassRuleParameters& parameters, const Dem& whole);

}  // namespace belvedere
