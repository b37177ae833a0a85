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
#include "terrain/shape/hydrology.h"
#include "terrain/shape/sea.h"

// Inputs of class rules from the terrain. Private to class_rules.
namespace belvedere::class_rules {

using Parameters = std::vector<std::pair<std::string, double>>;

// The slots of variables, in the order of the table of ground_variables.h. Those before
// `first_noise` are grids; noise, positions, climate and classes are computed row by row.
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
  riverside,
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
  radiation,  // of layers only, as sky_view
  sky_view,
  first_class
};
// Their names by slot; is_<class> follow from first_class on.
const std::vector<std::string>& variable_names();

// A parameter, or its default if the rules do not name it.
double parameter_or(const Parameters& parameters, const std::string& name, double otherwise);

// Replaces altitudes that the rules leave open (0) by offsets below the treeline at the centre of
// the map.
void resolve_altitudes(Parameters& parameters, const RuleClimate& climate, const Dem& dem);

// Settlements, given or to be inferred with these parameters.
struct SettlementInputs {
  const std::vector<KnownTown>& known;
  std::uint64_t seed = 1;
  const std::vector<TownSite>* sites = nullptr;  // null: they are inferred
};

// The grids that are needed (by slot), all of the DEM's size; others stay empty. ice and below_rock
// depend on the rules and stay empty. `catchments`: the DEM's; null: computed here. `settlements`,
// if given, receives the settlements if `town` is needed. `around`: of a window, for lakes that
// extend over its edge. `whole`: of a window, for wide means that extend over its edge.
std::vector<Grid<float>> make_terrain_inputs(
    const Dem& dem, const std::vector<bool>& needed, const Parameters& parameters,
    const SettlementInputs& settlement_inputs, const SeaParameters& sea_parameters,
    const RuleClimate& climate, Catchments* catchments = nullptr,
    std::vector<TownSite>* settlements = nullptr, const RuleGround* around = nullptr,
    const Dem* whole = nullptr);

// 1 just below rock, falling to 0 over `reach_m` down the fall line.
Grid<float> rock_above(const Grid<LandCoverClass>& classes, const Dem& dem, double reach_m);

// Cells whose class has no majority in their (window × window) neighbourhood take the class of the
// nearest cell that has one; window odd, below 3 off. Water and settlement keep every cell.
void remove_specks(Grid<LandCoverClass>& classes, int window);

}  // namespace belvedere::class_rules
