#include "terrain/cover/class_rules.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <regex>

#include "base/config.h"
#include "base/embedded.h"
#include "base/error.h"
#include "base/parallel.h"
#include "terrain/cover/class_rules_inputs.h"
#include "terrain/cover/layers_document.h"
#include "terrain/cover/rule_expression.h"
#include "terrain/cover/rule_ice.h"

namespace belvedere {
namespace {

using namespace class_rules;

constexpr char balance_term[] = "ice_balance";

// Where each text of a rules file stands; empty for rules that come from no file.
struct Places {
  std::vector<ConfigPlace> terms;
  std::vector<ConfigPlace> layers;
};

// Rules ready to run. Slots: the terrain's variables, then the terms.
struct Program {
  std::vector<RuleExpression> terms;
  std::vector<RuleExpression> layers;
  std::vector<std::vector<bool>> term_needs;  // slots a term reads, also through other terms
  std::vector<std::vector<bool>> layer_needs;
};

Program compile(const ClassRules& rules, const Parameters& parameters, const std::string& where, const Places& places) {
  const std::vector<std::string>& variables = variable_names();
  const std::size_t slots = variables.size() + rules.terms.size();
  Program program;
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
    if (name == balance_term) forbid(needs, ice, below_rock + 1, place, "ice_balance, which is computed before it");
    names.variables.push_back(name);
  }
  for (std::size_t i = 0; i < rules.layers.size(); ++i) {
    const std::string what = fmt::format("layer {} ({})", i + 1, class_name(rules.layers[i].painted_as));
    program.layers.push_back(compile_one(rules.layers[i].when, what, places.layers, i));
    program.layer_needs.push_back(needs_of(program.layers.back()));
  }
  return program;
}

Parameters with_settings(const ClassRules& rules, const Parameters& settings) {
  Parameters parameters = rules.parameters;
  for (const auto& [name, value] : settings) {
    const auto parameter = std::find_if(parameters.begin(), parameters.end(), [&, &key = name](const auto& p) { return p.first == key; });
    if (parameter != parameters.end()) {
      parameter->second = value;
      continue;
    }
    std::vector<std::string> known;
    for (const auto& p : parameters) known.push_back(p.first);
    const std::string near = nearest_word(name, known);
    throw Error(
        ErrorKind::usage, "setting " + name,
        fmt::format("unknown parameter of the class rules \"{}\"{}", rules.name, near.empty() ? "" : "; did you mean \"" + near + "\"?"),
        fmt::format("{}", fmt::join(known, ", ")));
  }
  return parameters;
}

// The state of one run over the DEM.
struct Run {
  const ClassRules& rules;
  const Program& program;
  const Dem& dem;
  std::uint64_t seed;
  const RuleClimate& climate;
  std::vector<Grid<float>> inputs;
  std::vector<NoiseColumns> noise;  // of each noise variable
  ClimateColumns columns = plan_climate_columns(climate, dem.transform, dem.width());
};

// Slots of one row, whole blocks long; each thread has its own.
struct Row {
  std::vector<std::vector<float>> slots;
  RuleExpression::Scratch scratch;
};

// Where the block of a slot begins at a column. Grids are read where they are, but for the last block, which must be whole.
const float* block_of(const Run& run, const Row& row, std::size_t slot, int y, int begin) {
  if (slot < static_cast<std::size_t>(first_noise) && begin + rule_block <= run.dem.width()) return run.inputs[slot].row(y) + begin;
  return row.slots[slot].data() + begin;
}

// Makes the needed slots of a row; `classes` is the row so far, or null. Terms come last, in their order.
void fill_row(const Run& run, const std::vector<bool>& needed, int y, const LandCoverClass* classes, Row& row) {
  const int width = run.dem.width();
  const std::size_t variables = variable_names().size();
  const int padded = (width + rule_block - 1) / rule_block * rule_block;
  row.slots.resize(needed.size());
  std::vector<const float*> pointers(needed.size(), nullptr);
  for (std::size_t v = 0; v < needed.size(); ++v) {
    if (!needed[v]) continue;
    std::vector<float>& out = row.slots[v];
    out.resize(static_cast<std::size_t>(padded), 0.F);
    const int variable = static_cast<int>(v);
    if (variable < first_noise) {
      const int last = padded - rule_block;
      std::copy_n(run.inputs[v].row(y) + last, width - last, out.begin() + last);
    } else if (variable < easting) {
      fill_noise(variable, run.noise[static_cast<std::size_t>(variable - first_noise)], run.seed, run.dem.transform, y, out.data());
    } else if (variable < first_climate) {
      for (int x = 0; x < width; ++x) {
        const glm::dvec2 place = run.dem.transform.to_crs(x, y);
        out[static_cast<std::size_t>(x)] = static_cast<float>(variable == easting ? place.x : place.y);
      }
    } else if (variable < first_class) {
      fill_climate_row(run.climate, run.columns, static_cast<ClimateVariable>(variable - first_climate), run.dem.transform, y,
                       run.dem.altitude_m.row(y), out.data());
    } else if (v < variables) {
      const auto id = static_cast<LandCoverClass>(variable - first_class);
      for (int x = 0; x < width; ++x) out[static_cast<std::size_t>(x)] = classes != nullptr && classes[x] == id ? 1.F : 0.F;
    } else {
      for (int begin = 0; begin < padded; begin += rule_block) {
        for (std::size_t i = 0; i < v; ++i) pointers[i] = needed[i] ? block_of(run, row, i, y, begin) : nullptr;
        run.program.terms[v - variables].evaluate(pointers, out.data() + begin, row.scratch);
      }
    }
  }
}

std::vector<bool> union_of(const std::vector<std::vector<bool>>& needs, std::size_t from, std::size_t to, std::size_t slots) {
  std::vector<bool> all(slots, false);
  for (std::size_t k = from; k < to; ++k)
    for (std::size_t i = 0; i < slots; ++i) all[i] = all[i] || needs[k][i];
  return all;
}

// Applies the layers from…to to all cells.
void apply_layers(const Run& run, std::size_t from, std::size_t to, Grid<LandCoverClass>& classes) {
  if (from == to) return;
  const std::size_t variables = variable_names().size();
  const std::size_t slots = variables + run.rules.terms.size();
  const std::vector<bool> needed = union_of(run.program.layer_needs, from, to, slots);
  const auto first = static_cast<std::size_t>(first_class);
  parallel_ranges(classes.height(), 16, [&](int y0, int y1) {
    Row row;
    std::array<float, rule_block> hit{};
    for (int y = y0; y != y1; ++y) {
      LandCoverClass* line = classes.row(y);
      fill_row(run, needed, y, line, row);
      std::vector<const float*> pointers(slots, nullptr);
      for (int begin = 0; begin < classes.width(); begin += rule_block) {
        const int count = std::min(rule_block, classes.width() - begin);
        for (std::size_t i = 0; i < slots; ++i) pointers[i] = needed[i] ? block_of(run, row, i, y, begin) : nullptr;
        for (std::size_t k = from; k < to; ++k) {
          const auto painted = static_cast<std::size_t>(run.rules.layers[k].painted_as);
          run.program.layers[k].evaluate(pointers, hit.data(), row.scratch);
          int hits = 0;
          for (const float h : hit) hits |= h > 0.F ? 1 : 0;
          if (hits == 0) continue;
          for (int x = 0; x < count; ++x) {
            if (!(hit[static_cast<std::size_t>(x)] > 0.F)) continue;
            const int at = begin + x;
            const auto place = static_cast<std::size_t>(at);
            const auto old = static_cast<std::size_t>(line[place]);
            // Later layers of this pass see the class so far.
            if (needed[first + old]) row.slots[first + old][place] = 0.F;
            if (needed[first + painted]) row.slots[first + painted][place] = 1.F;
            line[place] = run.rules.layers[k].painted_as;
          }
        }
      }
    }
  });
}

// The values of one term on all cells.
Grid<float> evaluate_term(const Run& run, std::size_t term) {
  std::vector<bool> needed = run.program.term_needs[term];
  const std::size_t slot = variable_names().size() + term;
  needed[slot] = true;
  Grid<float> out(run.dem.width(), run.dem.height());
  parallel_ranges(out.height(), 16, [&](int y0, int y1) {
    Row row;
    for (int y = y0; y != y1; ++y) {
      fill_row(run, needed, y, nullptr, row);
      std::copy_n(row.slots[slot].begin(), out.width(), out.row(y));
    }
  });
  return out;
}

}  // namespace

ClassRules read_class_rules(const std::string& name_or_path) {
  const std::vector<std::string> built_in = embedded_names("layers");
  const bool is_file = name_or_path.ends_with(".toml");
  if (!is_file && std::find(built_in.begin(), built_in.end(), name_or_path) == built_in.end())
    throw Error(ErrorKind::usage, name_or_path, "no class rules of that name",
                fmt::format("{}, or a .toml file", fmt::join(built_in, ", ")));
  const std::string where = is_file ? name_or_path : "layers/" + name_or_path + ".toml";
  const ConfigValue document = is_file ? read_config(name_or_path) : parse_config(embedded_file(where), where);

  ClassRules rules;
  Places places;
  const LayersReader reader{where};
  const LayersDocument common = read_layers_document(reader, document, {});
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
  compile(rules, rules.parameters, where, places);
  return rules;
}

bool uses_variable(const ClassRules& rules, const std::string& variable) {
  const Program program = compile(rules, rules.parameters, rules.name, {});
  const std::size_t slots = variable_names().size() + rules.terms.size();
  const std::vector<bool> needed = union_of(program.layer_needs, 0, program.layers.size(), slots);
  for (std::size_t v = 0; v < variable_names().size(); ++v)
    if (variable_names()[v] == variable) return needed[v];
  return false;
}

bool names_old_town(const std::string& parameter) {
  static const std::regex old_town("town_[0-9]+_(east|north|radius_m)");
  return std::regex_match(parameter, old_town);
}

namespace {

Parameters all_parameters(const ClassRules& rules, const ClassRuleParameters& given, const Dem& dem) {
  Parameters parameters = with_settings(rules, given.settings);
  resolve_altitudes(parameters, given.climate, dem);
  return parameters;
}

// Makes the run's inputs: what rules see of the ground, and in a window what they saw around it. Returns the ice.
RuleIce make_inputs(Run& run, const Parameters& parameters, const ClassRuleParameters& given, Progress& progress) {
  const auto& [rules, program, dem, seed, climate, inputs, noise, columns] = run;
  const std::size_t slots = variable_names().size() + rules.terms.size();
  // Ice needs the balance of snow and melting, and that needs variables of its own.
  std::vector<bool> needed = union_of(program.layer_needs, 0, program.layers.size(), slots);
  const auto balance = std::find_if(rules.terms.begin(), rules.terms.end(), [](const auto& t) { return t.first == balance_term; });
  const bool no_rivers = needed[river] && !given.rivers;
  if (no_rivers) needed[river] = false;
  const bool has_ice = needed[ice] && balance != rules.terms.end();
  if (has_ice) {
    const std::vector<bool>& needs = program.term_needs[static_cast<std::size_t>(balance - rules.terms.begin())];
    for (std::size_t i = 0; i < slots; ++i) needed[i] = needed[i] || needs[i];
  }
  const Settlers settlers{given.towns, given.seed, given.sites ? &*given.sites : nullptr};
  const RuleGround* around = given.around != nullptr ? &given.around->ground : nullptr;
  run.inputs = make_terrain_inputs(dem, needed, parameters, settlers, given.sea, climate, given.catchments, nullptr, around, given.whole);
  if (no_rivers) run.inputs[river] = Grid<float>(dem.width(), dem.height(), 0.F);
  for (int v = first_noise; v < easting; ++v)
    run.noise.push_back(needed[static_cast<std::size_t>(v)] ? plan_noise(v, dem.transform, dem.width()) : NoiseColumns{});
  progress.advance(1.0);
  RuleIce made;
  if (has_ice) {
    const std::vector<IceEntry> entries = around != nullptr ? find_ice_entries(*around, dem) : std::vector<IceEntry>();
    made = flowing_ice(evaluate_term(run, static_cast<std::size_t>(balance - rules.terms.begin())), dem, entries);
    run.inputs[ice] = std::move(made.covered);
  } else if (needed[ice]) {
    run.inputs[ice] = Grid<float>(dem.width(), dem.height(), 0.F);
  }
  if (around != nullptr) {
    const Grid<float> share = own_share(*given.around, dem.transform, dem.width(), dem.height(), seed);
    for (std::size_t v = 0; v < run.inputs.size(); ++v)
      join_input(run.inputs[v], around->inputs[v], share, dem.transform, around->transform);
  }
  progress.advance(1.0);
  return made;
}

RuleGround seen_by(Run&& run, RuleIce&& ice) {
  return {run.dem.transform, std::move(run.inputs), std::move(ice.km2), std::move(ice.surface_m)};
}

}  // namespace

RuleGround see_rule_ground(const ClassRules& rules, const ClassRuleParameters& given, const Dem& dem) {
  const Parameters parameters = all_parameters(rules, given, dem);
  const Program program = compile(rules, parameters, rules.name, {});
  Run run{rules, program, dem, given.seed, given.climate, {}, {}};
  RuleIce ice = make_inputs(run, parameters, given, silent_progress());
  return seen_by(std::move(run), std::move(ice));
}

LandCover apply_class_rules(const ClassRules& rules, const ClassRuleParameters& given, const Dem& dem, Progress& progress,
                            RuleGround* seen) {
  const Parameters parameters = all_parameters(rules, given, dem);
  const Program program = compile(rules, parameters, rules.name, {});
  progress.begin("class rules", 4.0);
  Run run{rules, program, dem, given.seed, given.climate, {}, {}};
  RuleIce made_ice = make_inputs(run, parameters, given, progress);

  // Layers that ask for rock uphill wait until the rock is there.
  Grid<LandCoverClass> classes(dem.width(), dem.height(), LandCoverClass::sky);
  std::size_t first = 0;
  while (first < rules.layers.size() && !program.layer_needs[first][below_rock]) ++first;
  apply_layers(run, 0, first, classes);
  if (first < rules.layers.size()) {
    run.inputs[below_rock] = rock_above(classes, dem, parameter_or(parameters, "apron_m", 400.0));
    apply_layers(run, first, rules.layers.size(), classes);
  }
  progress.advance(1.0);
  remove_specks(classes, static_cast<int>(parameter_or(parameters, "speck_cells", 5.0)));
  progress.advance(1.0);
  if (seen != nullptr) *seen = seen_by(std::move(run), std::move(made_ice));
  return {{std::move(classes), dem.transform, dem.crs}};
}

std::vector<TownSite> find_rule_towns(const ClassRules& rules, const ClassRuleParameters& given, const Dem& dem) {
  Parameters parameters = with_settings(rules, given.settings);
  resolve_altitudes(parameters, given.climate, dem);
  const Program program = compile(rules, parameters, rules.name, {});
  const std::size_t slots = variable_names().size() + rules.terms.size();
  std::vector<TownSite> found;
  if (!union_of(program.layer_needs, 0, program.layers.size(), slots)[town]) return found;
  std::vector<bool> needed(slots, false);
  for (const int variable : {town, slope, valley_floor}) needed[static_cast<std::size_t>(variable)] = true;
  make_terrain_inputs(dem, needed, parameters, {given.towns, given.seed}, given.sea, given.climate, given.catchments, &found);
  return found;
}

ClassRuleParameters parameters_for_parts(const ClassRules& rules, const ClassRuleParameters& given, const Dem& whole) {
  ClassRuleParameters parts = given;
  parts.settings = with_settings(rules, given.settings);
  resolve_altitudes(parts.settings, given.climate, whole);
  if (!parts.sites) parts.sites = find_rule_towns(rules, parts, whole);
  parts.catchments = nullptr;
  return parts;
}

}  // namespace belvedere
