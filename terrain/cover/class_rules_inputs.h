#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/land_cover_class.h"
#include "terrain/climate/rule_climate.h"
#include "terrain/cover/rule_ground.h"
#include "terrain/cover/towns.h"
#include "terrain/io/dem.h"
#include "terrain/shape/catchments.h"
#include "terrain/shape/sea.h"

// What class rules can know of the terrain. Private to class_rules.
namespace belvedere::class_rules {

using Parameters = std::vector<std::pair<std::string, double>>;

// The slots of variables, in the order of the table of ground_variables.h. Those before `first_noise` are grids; noise, places, climate and
// classes are made row by row.
enum Variable : int {
  altitude,
  slope,
  slope_smooth,
  north,
  south,
  east,
  relief_180,
  relief_750,
  relief_1800,
  relief_4000,
  valley_height,
  above_valley,
  valley_floor,
  log_catchment,
  flatness,
  roughness,
  sun,
  lake,
  shore,
  river,
  sea,
  coast,
  town,
  ice,
  below_rock,
  first_noise,
  n60 = first_noise,
  n210,
  n660,
  n1800,
  easting,
  northing,
  first_climate,
  treeline = first_climate,
  iceline,
  snowline,
  season_snow,
  moisture,
  temperature,
  rain,
  radiation,  // of layers alone, as sky_view
  sky_view,
  first_class
};
// Their names by slot; is_<class> follow from first_class on.
const std::vector<std::string>& variable_names();

// A parameter, or what it is where the rules do not name it.
double parameter_or(const Parameters& parameters, const std::string& name, double otherwise);

// Altitudes that rules leave open (0) and of which a map has one: so far below the treeline in its middle.
void resolve_altitudes(Parameters& parameters, const RuleClimate& climate, const Dem& dem);

// Who lives where: settlements that are found already, or else what they are looked for with.
struct Settlers {
  const std::vector<KnownTown>& known;
  std::uint64_t seed = 1;
  const std::vector<TownSite>* sites = nullptr;  // null: they are looked for
};

// The grids that are needed (by slot), all of the DEM's size; others stay empty. ice and below_rock depend on the rules and stay empty.
// `catchments`: the DEM's, null: they are found here. `settlements` gets the settlements, where it is given and `town` is needed.
// `around`: of a window; what it cannot know of lakes that reach over its rim. `whole`: of a window; wide means reach over it.
std::vector<Grid<float>> make_terrain_inputs(const Dem& dem, const std::vector<bool>& needed, const Parameters& parameters,
                                             const Settlers& settlers, const SeaParameters& sea_parameters, const RuleClimate& climate,
                                             Catchments* catchments = nullptr, std::vector<TownSite>* settlements = nullptr,
                                             const RuleGround* around = nullptr, const Dem* whole = nullptr);

// 1 just below rock, falling to 0 over `reach_m` down the fall line.
Grid<float> rock_above(const Grid<LandCoverClass>& classes, const Dem& dem, double reach_m);

// Cells whose (window × window) neighbourhood holds no majority of their class take the class of the nearest cell that is not
// so; window odd, below 3 off. Water and settlement keep every cell.
void remove_specks(Grid<LandCoverClass>& classes, int window);

}  // namespace belvedere::class_rules
