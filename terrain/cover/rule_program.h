#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/config.h"
#include "base/land_cover_class.h"
#include "terrain/cover/rule_expression.h"

namespace belvedere {

// Land cover for a DEM that has none, from rules in a file of their own (data/layers/life_zones.toml): surface layers in order, each with a
// class and conditions over altitude, slope, exposure, relief, climate, noise and water; later layers win. docs/class_rules.md describes
// the file and the variables.
struct ClassRules {
  struct Layer {
    LandCoverClass painted_as;
    std::string when;  // an expression (terrain/cover/rule_expression.h); true where > 0
  };
  std::string name;
  std::vector<std::pair<std::string, double>> parameters;  // named numbers that expressions may use and a scene may set
  std::vector<std::pair<std::string, std::string>> terms;  // named sub-expressions, evaluated in order
  std::vector<Layer> layers;
  std::string rivers = {};  // an expression: where guessed rivers run as lines, > 0; none: `river` alone tells of them
};

// Built-in name ("life_zones") or a .toml file. Every expression is checked: Error(usage) with file:line:column and the nearest
// known name.
ClassRules read_class_rules(const std::string& name_or_path);

// Whether the rules look at a variable of docs/class_rules.md, be it through a term.
bool uses_variable(const ClassRules& rules, const std::string& variable);

// Whether a name is one by which rules once knew towns: town_1_east, town_1_north, town_1_radius_m, town_2_…
bool names_old_town(const std::string& parameter);

// The term by which rules say how much snow is left over; ice is computed from it.
inline constexpr char ice_balance_term[] = "ice_balance";

// Where each text of a rules file stands; empty for rules that come from no file.
struct RulePlaces {
  std::vector<ConfigPlace> terms;
  std::vector<ConfigPlace> layers;
  std::vector<ConfigPlace> rivers;  // one at most
};

// Rules ready to run. Slots: the terrain's variables, then the terms.
struct RuleProgram {
  std::vector<RuleExpression> terms;
  std::vector<RuleExpression> layers;
  std::vector<std::vector<bool>> term_needs;  // slots a term reads, also through other terms
  std::vector<std::vector<bool>> layer_needs;
  std::optional<RuleExpression> rivers = {};  // where guessed ones run
  std::vector<bool> river_needs = {};
};

// Slots that any of needs[from] … needs[to - 1] reads.
std::vector<bool> union_of(const std::vector<std::vector<bool>>& needs, std::size_t from, std::size_t to, std::size_t slots);
// What layers and rivers read.
std::vector<bool> all_needs(const RuleProgram& program, std::size_t slots);

// Error(usage) at the place of a text that is no expression, or asks for what is not known there. `where`: the file, for messages.
RuleProgram compile_rules(const ClassRules& rules, const std::vector<std::pair<std::string, double>>& parameters, const std::string& where,
                          const RulePlaces& places);

}  // namespace belvedere
