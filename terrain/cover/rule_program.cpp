#include "terrain/cover/rule_program.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <regex>

#include "base/error.h"
#include "base/text/embedded.h"
#include "terrain/cover/class_rules_inputs.h"
#include "terrain/cover/layers_document.h"

namespace belvedere {

using namespace class_rules;

std::vector<bool> union_of(const std::vector<std::vector<bool>>& needs, std::size_t from, std::size_t to, std::size_t slots) {
  std::vector<bool> all(slots, false);
  for (std::size_t k = from; k < to; ++k)
    for (std::size_t i = 0; i < slots; ++i) all[i] = all[i] || needs[k][i];
  return all;
}

std::vector<bool> all_needs(const RuleProgram& program, std::size_t slots) {
  std::vector<bool> all = union_of(program.layer_needs, 0, program.layers.size(), slots);
  for (std::size_t i = 0; i < program.river_needs.size(); ++i) all[i] = all[i] || program.river_needs[i];
  return all;
}

RuleProgram compile_rules(const ClassRules& rules, const std::vector<std::pair<std::string, double>>& parameters, const std::string& where,
                          const RulePlaces& places) {
  const std::vector<std::string>& variables = variable_names();
  const std::size_t slots = variables.size() + rules.terms.size();
  RuleProgram program;
  RuleNames names{variables, parameters};
  const auto needs_of = [&](const RuleExpression& expression) {
    std::vector<bool> needs(slots, false);
    for (const int v : expression.variables()) {
      const auto slot = static_cast<std::size_t>(v);
      needs[slot] = true;
      if (slot < variables.size()) continue;
      const std::vector<bool>& of_term = program.term_needs[slot - variables.size()];
      for (std::size_t i = 0; i < slots; ++i) needs[i] = needs[i] || of_term[i];
    }
    return needs;
  };
  // Classes so far exist in layers only; and what makes the ice cannot know where the ice is.
  const auto forbid = [&](const std::vector<bool>& needs, int from, int to, const std::string& place, const std::string& reason) {
    for (int v = from; v < to; ++v)
      if (needs[static_cast<std::size_t>(v)])
        throw Error(ErrorKind::usage, place, fmt::format("\"{}\" in {}", variables[static_cast<std::size_t>(v)], reason), "");
  };
  const auto compile_one = [&](const std::string& text, const std::string& what, const std::vector<ConfigPlace>& from, std::size_t i) {
    return from.empty() ? RuleExpression(text, names, where + ", " + what, {}) : RuleExpression(text, names, where, from[i]);
  };

  for (std::size_t i = 0; i < rules.terms.size(); ++i) {
    const auto& [name, text] = rules.terms[i];
    program.terms.push_back(compile_one(text, "term " + name, places.terms, i));
    program.term_needs.push_back(needs_of(program.terms.back()));
    const std::string place = places.terms.empty() ? where + ", term " + name : config_where(where, places.terms[i]);
    const std::vector<bool>& needs = program.term_needs.back();
    forbid(needs, first_class, static_cast<int>(variables.size()), place, "a term; only layers know the class so far");
    if (name == ice_balance_term) forbid(needs, ice, below_rock + 1, place, "ice_balance, which is computed before it");
    names.variables.push_back(name);
  }
  for (std::size_t i = 0; i < rules.layers.size(); ++i) {
    const std::string what = fmt::format("layer {} ({})", i + 1, class_name(rules.layers[i].painted_as));
    program.layers.push_back(compile_one(rules.layers[i].when, what, places.layers, i));
    program.layer_needs.push_back(needs_of(program.layers.back()));
  }
  if (!rules.rivers.empty()) {
    program.rivers = compile_one(rules.rivers, "rivers", places.rivers, 0);
    program.river_needs = needs_of(*program.rivers);
  }
  return program;
}

ClassRules read_class_rules(const std::string& name_or_path) {
  const std::vector<std::string> built_in = embedded_names("layers");
  const bool is_file = name_or_path.ends_with(".toml");
  if (!is_file && std::find(built_in.begin(), built_in.end(), name_or_path) == built_in.end())
    throw Error(ErrorKind::usage, name_or_path, "no class rules of that name",
                fmt::format("{}, or a .toml file", fmt::join(built_in, ", ")));
  const std::string where = is_file ? name_or_path : "layers/" + name_or_path + ".toml";
  const ConfigValue document = is_file ? read_config(name_or_path) : parse_config(embedded_file(where), where);

  ClassRules rules;
  RulePlaces places;
  const LayersReader reader{where};
  const LayersDocument common = read_layers_document(reader, document, {"rivers"});
  rules.name = common.name.empty() ? name_or_path : common.name;
  rules.parameters = common.parameters;
  rules.terms = common.terms;
  places.terms = common.term_places;
  if (const ConfigValue* parameters = find(as_table(document, where), "parameters"))
    for (const ConfigEntry& entry : as_table(*parameters, where))
      if (names_old_town(entry.key))
        reader.fail(entry.key_place, "towns are no parameters of rules any more: " + entry.key,
                    "towns of the scene, with name, position and radius");
  for (const ConfigValue& value : layers_of(reader, document)) {
    const ConfigTable& layer = as_table(value, where);
    allow_only(layer, {"name", "class", "when"}, where);
    const LandCoverClass painted_as = reader.land_cover_class(reader.required(layer, "class", value.place, "a layer"));
    const ConfigValue& when = reader.required(layer, "when", value.place, "a layer");
    rules.layers.push_back({painted_as, reader.expression(when)});
    places.layers.push_back(when.place);
  }
  if (const ConfigValue* rivers = find(as_table(document, where), "rivers")) {
    rules.rivers = reader.expression(*rivers);
    places.rivers.push_back(rivers->place);
  }
  compile_rules(rules, rules.parameters, where, places);
  return rules;
}

bool uses_variable(const ClassRules& rules, const std::string& variable) {
  const RuleProgram program = compile_rules(rules, rules.parameters, rules.name, {});
  const std::size_t slots = variable_names().size() + rules.terms.size();
  const std::vector<bool> needed = all_needs(program, slots);
  for (std::size_t v = 0; v < variable_names().size(); ++v)
    if (variable_names()[v] == variable) return needed[v];
  return false;
}

bool names_old_town(const std::string& parameter) {
  static const std::regex old_town("town_[0-9]+_(east|north|radius_m)");
  return std::regex_match(parameter, old_town);
}

}  // namespace belvedere
