#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace belvedere {

// What class rules and surface layers can know of a place. They speak one language: a name means the same in expressions of both and in
// functions of layers. The one table is ground_variables.cpp; docs/class_rules.md has it for people.

// Grids of the ground that layer_inputs.h makes for any rectangle: expressions and functions may have them.
enum class LayerInputKind : std::uint8_t {
  none,  // not among them
  altitude,
  slope,
  north,
  south,
  east,
  relief,  // over the mean of `reach_m` around
  above_valley,
  catchment,
  flatness,
  roughness,
  // Given by the caller (LayerClimate).
  temperature,
  rain,
  radiation,
  sky_view,
  treeline,
  lake,
  sea,
};

// Who knows a variable.
enum class KnownTo : std::uint8_t {
  both,
  rules,   // it needs the whole map, or what was painted before
  layers,  // it needs more than rules are given
};

struct GroundVariable {
  std::string_view name;       // as files write it
  std::string_view unit = {};  // empty: a number
  std::string_view meaning;
  KnownTo known_to = KnownTo::both;
  LayerInputKind input = LayerInputKind::none;
  double reach_m = 0.0;   // of relief: what is the mean of so much around …
  double smooth_m = 0.0;  // … taken from the ground smoothed by that (deviation)
  double noise_m = 0.0;   // noise with patches of so many metres; 0: none
};
// Variables of is_<class> follow from the classes and are not in it.
const std::vector<GroundVariable>& ground_variables();
const GroundVariable* find_ground_variable(std::string_view name);  // null for a name that is none

// Names in expressions by slot: the table, then is_<class>. Empty where rules or layers do not know it.
std::vector<std::string> expression_names(KnownTo who);

// What a function is of: a variable with an input kind, and the range that samples are spread over. Values beyond it count as its ends.
struct LayerInput {
  std::string name;
  double low = 0.0;  // in the variable's unit, low < high
  double high = 1.0;
};
// Those that functions of layers may have: with an input kind.
std::vector<std::string> layer_input_names();
// The kind of an input; none for names that are no input.
LayerInputKind layer_input_kind(std::string_view name);
// Error(usage) with the nearest known name for what is no input of layers.
void require_layer_input(const std::string& name, const std::string& where);

// Deviation of the Gaussian that the ground goes through before slopes and exposures are taken: those of a raw DEM show its stripes.
inline constexpr double slope_smooth_m = 60.0;
// Level ground has no exposure: it fades out around this rise, metres a metre.
inline constexpr double exposure_fade = 0.02;

// The table as docs/class_rules.md has it.
std::string describe_ground_variables();

}  // namespace belvedere
