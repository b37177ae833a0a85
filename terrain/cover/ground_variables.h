#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace belvedere {

// Variables of class rules and surface layers. Names have the same meaning in expressions of both
// and in functions of layers. The table is in ground_variables.cpp; docs/class_rules.md lists it.

// Grids of the ground that layer_inputs.h makes for any rectangle; available in expressions and
// functions.
enum class LayerInputKind : std::uint8_t {
  none,  // not among them
  altitude,
  slope,
  north,
  south,
  east,
  relief,  // height above the mean within `reach_m`
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

// Where a variable is available.
enum class KnownTo : std::uint8_t {
  both,
  rules,   // needs the whole map, or the layers painted before
  layers,  // needs inputs that rules do not have
};

struct GroundVariable {
  std::string_view name;       // as in files
  std::string_view unit = {};  // empty: a number
  std::string_view meaning;
  KnownTo known_to = KnownTo::both;
  LayerInputKind input = LayerInputKind::none;
  double reach_m = 0.0;   // of relief: radius of the mean …
  double smooth_m = 0.0;  // … of the ground smoothed by this standard deviation
  double noise_m = 0.0;   // size of the noise's patches, m; 0: not noise
};
// Variables is_<class> follow from the classes and are not in the table.
const std::vector<GroundVariable>& ground_variables();
const GroundVariable* find_ground_variable(std::string_view name);  // null for unknown names

// Names in expressions by slot: the table, then is_<class>. Empty if not available in rules or
// layers.
std::vector<std::string> expression_names(KnownTo who);

// The argument of a function: a variable with an input kind, and the range over which samples are
// spread. Values beyond it are clamped.
struct LayerInput {
  std::string name;
  double low = 0.0;  // in the variable's unit, low < high
  double high = 1.0;
};
// Variables that functions of layers can use: those with an input kind.
std::vector<std::string> layer_input_names();
// The kind of an input; none for names that are not inputs.
LayerInputKind layer_input_kind(std::string_view name);
// Error(usage) with the closest known name if it is not an input of layers.
void require_layer_input(const std::string& name, const std::string& where);

// Standard deviation of the Gaussian applied before slopes and exposures are computed: a raw DEM
// would show its stripes.
inline constexpr double slope_smooth_m = 60.0;
// Level ground has no exposure: it fades out below about this rise, metres per metre.
inline constexpr double exposure_fade = 0.02;

}  // namespace belvedere
