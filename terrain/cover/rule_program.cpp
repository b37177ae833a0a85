#include "terrain/cover/rule_program.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <regex>

#include "base/error.h"
#include "base/text/config_reader.h"
#include "terrain/cover/class_rules_inputs.h"
#include "terrain/cover/ground_variables.h"
#include "terrain/cover/layer_inputs.h"

namespace belvedere {

using namespace class_rules;

namespace {

// Counted from the raster's first column, so that rounding does not depend on the rectangle.
NoiseColumns plan_noise(const GeoTransform& transform, const PixelRect& cells, double sigma_m) {
  NoiseColumns plan =
      plan_noise_columns(transform.to_crs(0.0, 0.0).x, transform.cell_x, cells.x1, sigma_m);
  plan.columns.erase(plan.columns.begin(), plan.columns.begin() + cells.x0);
  const int skipped = plan.columns.front().first;
  for (NoiseColumns::Column& column : plan.columns) column.first -= skipped;
  plan.first_column += skipped;
  plan.lattice_columns -= skipped;
  return plan;
}

std::size_t first_noise_slot() {
  const std::vector<GroundVariable>& table = ground_variables();
  const auto first = std::find_if(table.begin(), table.end(),
                                  [](const GroundVariable& row) { return row.noise_m > 0.0; });
  return static_cast<std::size_t>(first - table.begin());
}

}  // namespace

std::vector<bool> RuleProgram::needs_of(std::size_t from, std::size_t to) const {
  std::vector<bool> all(needs.empty() ? 0 : needs.front().size(), false);
  for (std::size_t k = from; k < to; ++k)
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = all[i] || needs[k][i];
  return all;
}

RuleProgram compile_expressions(const std::vector<std::string>& variables,
                                const NamedNumbers& parameters,
                                const std::vector<std::pair<std::string, std::string>>& terms,
                                const std::vector<RuleCondition>& conditions,
                                const std::string& where, const RulePlaces& positions) {
  const std::size_t slots = variables.size() + terms.size();
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
  const auto compile_one = [&](const std::string& text, const std::string& what,
                               const std::vector<ConfigPosition>& from, std::size_t i) {
    return from.empty() ? RuleExpression(text, names, where + ", " + what, {})
                        : RuleExpression(text, names, where, from[i]);
  };
  for (std::size_t i = 0; i < terms.size(); ++i) {
    program.terms.push_back(
        compile_one(terms[i].second, "term " + terms[i].first, positions.terms, i));
    program.term_needs.push_back(needs_of(program.terms.back()));
    names.variables.push_back(terms[i].first);
  }
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    program.conditions.emplace_back();
    program.needs.emplace_back(slots, false);
    if (conditions[i].text.empty()) continue;
    program.conditions.back() =
        compile_one(conditions[i].text, conditions[i].what, positions.conditions, i);
    program.needs.back() = needs_of(*program.conditions.back());
  }
  return program;
}

RuleProgram compile_rules(const ClassRules& rules, const NamedNumbers& parameters,
                          const std::string& where, const RulePlaces& positions) {
  const std::vector<std::string>& variables = variable_names();
  std::vector<RuleCondition> conditions;
  for (const ClassRules::Layer& layer : rules.layers)
    conditions.push_back({layer.when, fmt::format("layer {} ({})", conditions.size() + 1,
                                                  class_name(layer.painted_as))});
  conditions.push_back({rules.rivers, "rivers"});
  RuleProgram program =
      compile_expressions(variables, parameters, rules.terms, conditions, where, positions);
  // Classes so far exist only in layers, and the ice balance cannot use the ice.
  for (std::size_t i = 0; i < rules.terms.size(); ++i) {
    const std::string& name = rules.terms[i].first;
    const auto forbid = [&](int from, int to, const std::string& reason) {
      for (auto v = static_cast<std::size_t>(from); v < static_cast<std::size_t>(to); ++v)
        if (program.term_needs[i][v])
          throw Error(ErrorKind::usage,
                      positions.terms.empty() ? where + ", term " + name
                                              : config_where(where, positions.terms[i]),
                      fmt::format("\"{}\" in {}", variables[v], reason), "");
    };
    forbid(first_class, static_cast<int>(variables.size()),
           "a term; the class so far is available only in layers");
    if (name == ice_balance_term)
      forbid(ice, below_rock + 1, "ice_balance, which is computed before it");
  }
  return program;
}

NamedNumbers with_settings(NamedNumbers parameters, const NamedNumbers& settings,
                           const std::string& whose) {
  for (const auto& [name, value] : settings) {
    const auto parameter = std::find_if(parameters.begin(), parameters.end(),
                                        [&, &key = name](const auto& p) { return p.first == key; });
    if (parameter != parameters.end()) {
      parameter->second = value;
      continue;
    }
    std::vector<std::string> known;
    for (const auto& p : parameters) known.push_back(p.first);
    throw Error(ErrorKind::usage, "setting " + name,
                fmt::format("unknown parameter of {}{}", whose, nearest_word_hint(name, known)),
                known.empty() ? "none: the file has no parameters"
                              : fmt::format("{}", fmt::join(known, ", ")));
  }
  return parameters;
}

ClassRules read_class_rules(const std::string& name_or_path) {
  const auto [document, where] = read_named_config("layers", name_or_path, "class rules");
  ClassRules rules;
  RulePlaces positions;
  const LayersReader reader{where};
  const LayersDocument common = read_layers_document(reader, document, {"rivers"});
  rules.name = common.name.empty() ? name_or_path : common.name;
  rules.parameters = common.parameters;
  rules.terms = common.terms;
  positions.terms = common.term_places;
  if (const ConfigValue* parameters = find(as_table(document, where), "parameters"))
    for (const ConfigEntry& entry : as_table(*parameters, where))
      if (names_old_town(entry.key))
        reader.fail(entry.key_position, "towns are not parameters of rules: " + entry.key,
                    "towns of the scene, with name, position and radius");
  for (const ConfigValue& value : layers_of(reader, document)) {
    allow_only(as_table(value, where), {"name", "class", "when"}, where);
    const LandCoverClass painted_as =
        as_ground_class(required(value, "class", where, "a class of the ground"), where);
    const ConfigValue& when = required(value, "when", where, "when = \"a condition\"");
    rules.layers.push_back({painted_as, reader.expression(when)});
    positions.conditions.push_back(when.position);
  }
  if (const ConfigValue* rivers = find(as_table(document, where), "rivers")) {
    rules.rivers = reader.expression(*rivers);
    positions.conditions.push_back(rivers->position);
  }
  compile_rules(rules, rules.parameters, where, positions);
  return rules;
}

bool uses_variable(const ClassRules& rules, const std::string& variable) {
  const RuleProgram program = compile_rules(rules, rules.parameters, rules.name, {});
  const std::vector<bool> needed = program.all_needs();
  for (std::size_t v = 0; v < variable_names().size(); ++v)
    if (variable_names()[v] == variable) return needed[v];
  return false;
}

bool names_old_town(const std::string& parameter) {
  static const std::regex old_town("town_[0-9]+_(east|north|radius_m)");
  return std::regex_match(parameter, old_town);
}

RuleGrids::RuleGrids(const RuleProgram& of, std::vector<bool> slots, const GeoTransform& at,
                     const PixelRect& rectangle, std::uint64_t number,
                     std::vector<const Grid<float>*> known, Fill filled)
    : program(of),
      needed(std::move(slots)),
      transform(at),
      cells(rectangle),
      seed(number),
      grids(std::move(known)),
      fill(std::move(filled)) {
  const std::vector<GroundVariable>& table = ground_variables();
  grids.resize(needed.size(), nullptr);
  for (std::size_t v = first_noise_slot(); v < table.size() && table[v].noise_m > 0.0; ++v)
    noise.push_back(needed[v] ? plan_noise(transform, cells, table[v].noise_m) : NoiseColumns{});
}

RuleRows::RuleRows(const RuleGrids& grids)
    : of_(grids), rows_(grids.needed.size()), pointers_(grids.needed.size(), nullptr) {}

void RuleRows::start(int y) {
  static const std::size_t first_noise = first_noise_slot();
  y_ = y;
  const int width = of_.cells.width();
  const int padded = (width + rule_block - 1) / rule_block * rule_block;
  const std::size_t variables = of_.needed.size() - of_.program.terms.size();
  for (std::size_t v = 0; v < rows_.size(); ++v) {
    if (!of_.needed[v]) continue;
    std::vector<float>& out = rows_[v];
    out.resize(static_cast<std::size_t>(padded), 0.F);
    if (of_.grids[v] != nullptr) {
      // Grids are read in place, except the last block, which must be complete.
      const int last = padded - rule_block;
      std::copy_n(of_.grids[v]->row(y) + last, width - last, out.begin() + last);
    } else if (v - first_noise < of_.noise.size()) {
      gaussian_noise_row(of_.noise[v - first_noise],
                         stream_seed(of_.seed, Stream::class_noise, v - first_noise),
                         of_.transform.to_crs(of_.cells.x0, of_.cells.y0 + y).y, out.data());
    } else if (v < variables) {
      of_.fill(v, y, out.data());
    } else {
      for (int begin = 0; begin < padded; begin += rule_block) {
        go_to(begin);
        evaluate(of_.program.terms[v - variables], out.data() + begin);
      }
    }
  }
}

void RuleRows::go_to(int begin) {
  for (std::size_t v = 0; v < rows_.size(); ++v) {
    if (rows_[v].empty()) continue;  // not needed, or a term that comes later
    const bool in_place = of_.grids[v] != nullptr && begin + rule_block <= of_.cells.width();
    pointers_[v] = in_place ? of_.grids[v]->row(y_) + begin : rows_[v].data() + begin;
  }
}

}  // namespace belvedere
