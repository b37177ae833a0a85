#include "terrain/cover/class_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "base/error.h"
#include "base/parallel.h"
#include "terrain/cover/class_rules_inputs.h"
#include "terrain/cover/rule_expression.h"
#include "terrain/cover/rule_ice.h"
#include "terrain/cover/rule_program.h"
#include "terrain/shape/inferred_rivers.h"

namespace belvedere {
namespace {

using namespace class_rules;

// The state of one run over the DEM.
struct Run {
  const ClassRules& rules;
  const RuleProgram& program;
  const Dem& dem;
  std::uint64_t seed;
  const RuleClimate& climate;
  std::vector<Grid<float>> inputs;
  ClimateColumns columns = plan_climate_columns(climate, dem.transform, dem.width());
};

// The values that expressions see; `classes` are the classes so far, or null if not needed.
RuleGrids grids_of(const Run& run, std::vector<bool> needed, const Grid<LandCoverClass>* classes) {
  std::vector<const Grid<float>*> grids;
  for (const Grid<float>& input : run.inputs) grids.push_back(&input);
  const auto fill = [&run, classes](std::size_t slot, int y, float* out) {
    const int width = run.dem.width();
    const int variable = static_cast<int>(slot);
    if (variable < first_climate) {
      for (int x = 0; x < width; ++x) {
        const glm::dvec2 position = run.dem.transform.to_crs(x, y);
        out[x] = static_cast<float>(variable == easting ? position.x : position.y);
      }
    } else if (variable < first_class) {
      fill_climate_row(run.climate, run.columns,
                       static_cast<ClimateVariable>(variable - first_climate), run.dem.transform, y,
                       run.dem.altitude_m.row(y), out);
    } else {
      const LandCoverClass* line = classes->row(y);
      for (int x = 0; x < width; ++x)
        out[x] = line[x] == static_cast<LandCoverClass>(variable - first_class) ? 1.F : 0.F;
    }
  };
  return {run.program,
          std::move(needed),
          run.dem.transform,
          {0, 0, run.dem.width(), run.dem.height()},
          run.seed,
          std::move(grids),
          fill};
}

// Applies the layers from…to to all cells.
void apply_layers(const Run& run, std::size_t from, std::size_t to, Grid<LandCoverClass>& classes) {
  if (from == to) return;
  const RuleGrids grids = grids_of(run, run.program.needs_of(from, to), &classes);
  const std::vector<bool>& needed = grids.needed;
  const auto first = static_cast<std::size_t>(first_class);
  parallel_ranges(classes.height(), 16, [&](int y0, int y1) {
    RuleRows rows(grids);
    std::array<float, rule_block> hit{};
    for (int y = y0; y != y1; ++y) {
      LandCoverClass* line = classes.row(y);
      rows.start(y);
      for (int begin = 0; begin < classes.width(); begin += rule_block) {
        const int count = std::min(rule_block, classes.width() - begin);
        rows.go_to(begin);
        for (std::size_t k = from; k < to; ++k) {
          const auto painted = static_cast<std::size_t>(run.rules.layers[k].painted_as);
          rows.evaluate(*run.program.conditions[k], hit.data());
          int hits = 0;
          for (const float h : hit) hits |= h > 0.F ? 1 : 0;
          if (hits == 0) continue;
          for (int x = 0; x < count; ++x) {
            if (!(hit[static_cast<std::size_t>(x)] > 0.F)) continue;
            const int at = begin + x;
            const auto old = static_cast<std::size_t>(line[at]);
            // Later layers of this pass see the class so far.
            if (needed[first + old]) rows.row(first + old)[at] = 0.F;
            if (needed[first + painted]) rows.row(first + painted)[at] = 1.F;
            line[at] = run.rules.layers[k].painted_as;
          }
        }
      }
    }
  });
}

// River cells: the catchment is large enough and the rules allow rivers. Rows without such cells
// are skipped.
Grid<std::uint8_t> find_river_beds(const Run& run, const Grid<float>& catchment_km2, double min_km2,
                                   const Grid<LandCoverClass>& classes) {
  const RuleGrids grids = grids_of(run, run.program.needs.back(), &classes);
  Grid<std::uint8_t> beds(classes.width(), classes.height(), 0);
  parallel_ranges(beds.height(), 16, [&](int y0, int y1) {
    RuleRows rows(grids);
    std::array<float, rule_block> hit{};
    for (int y = y0; y != y1; ++y) {
      const float* water = catchment_km2.row(y);
      const auto is_river = [&](float km2) { return static_cast<double>(km2) >= min_km2; };
      if (std::none_of(water, water + beds.width(), is_river)) continue;
      rows.start(y);
      for (int begin = 0; begin < beds.width(); begin += rule_block) {
        const int count = std::min(rule_block, beds.width() - begin);
        if (std::none_of(water + begin, water + begin + count, is_river)) continue;
        rows.go_to(begin);
        rows.evaluate(*run.program.conditions.back(), hit.data());
        for (int x = 0; x < count; ++x)
          beds(begin + x, y) = hit[static_cast<std::size_t>(x)] > 0.F ? 1 : 0;
      }
    }
  });
  return beds;
}

// Inferred rivers as lines.
std::vector<CoverRiver> infer_rivers(const Run& run, const Grid<float>& catchment_km2,
                                     const Grid<LandCoverClass>& classes) {
  InferredRiverParameters parameters;
  parameters.seed = run.seed;
  const Grid<std::uint8_t> beds = find_river_beds(run, catchment_km2, parameters.min_km2, classes);
  std::vector<RiverCentreline> centrelines = infer_rivers_of_ground(
      catchment_km2, run.dem.altitude_m, run.dem.transform,
      [&](int x, int y) {
        if (classes(x, y) == LandCoverClass::water) return RiverBed::open;
        return beds(x, y) != 0 ? RiverBed::runs : RiverBed::dry;
      },
      parameters);
  std::vector<CoverRiver> rivers;
  for (RiverCentreline& centreline : centrelines)
    rivers.push_back({.positions = std::move(centreline.positions),
                      .half_width_m = std::move(centreline.half_width_m)});
  return rivers;
}

// The values of one term on all cells.
Grid<float> evaluate_term(const Run& run, std::size_t term) {
  std::vector<bool> needed = run.program.term_needs[term];
  const std::size_t slot = variable_names().size() + term;
  needed[slot] = true;
  const RuleGrids grids = grids_of(run, std::move(needed), nullptr);
  Grid<float> out(run.dem.width(), run.dem.height());
  parallel_ranges(out.height(), 16, [&](int y0, int y1) {
    RuleRows rows(grids);
    for (int y = y0; y != y1; ++y) {
      rows.start(y);
      std::copy_n(rows.row(slot), out.width(), out.row(y));
    }
  });
  return out;
}

Parameters all_parameters(const ClassRules& rules, const ClassRuleParameters& given,
                          const Dem& dem) {
  Parameters parameters = with_settings(rules.parameters, given.settings,
                                        fmt::format("the class rules \"{}\"", rules.name));
  resolve_altitudes(parameters, given.climate, dem);
  return parameters;
}

// Makes the run's inputs: the ground variables, and in a window those of the surrounding ground.
// Returns the ice.
RuleIce make_inputs(Run& run, const Parameters& parameters, const ClassRuleParameters& given,
                    Catchments& waters, Progress& progress) {
  const auto& [rules, program, dem, seed, climate, inputs, columns] = run;
  // Ice depends on the balance of snow and melt, which needs variables of its own.
  std::vector<bool> needed = program.all_needs();
  const auto balance = std::find_if(rules.terms.begin(), rules.terms.end(),
                                    [](const auto& t) { return t.first == ice_balance_term; });
  const bool no_rivers = needed[river] && !given.rivers;
  if (no_rivers) needed[river] = false;
  const bool has_ice = needed[ice] && balance != rules.terms.end();
  if (has_ice) {
    const std::vector<bool>& needs =
        program.term_needs[static_cast<std::size_t>(balance - rules.terms.begin())];
    for (std::size_t i = 0; i < needed.size(); ++i) needed[i] = needed[i] || needs[i];
  }
  const SettlementInputs settlement_inputs{given.towns, given.seed,
                                           given.sites ? &*given.sites : nullptr};
  const RuleGround* around = given.around != nullptr ? &given.around->ground : nullptr;
  run.inputs = make_terrain_inputs(dem, needed, parameters, settlement_inputs, given.sea, climate,
                                   &waters, nullptr, around, given.whole);
  if (no_rivers) run.inputs[river] = Grid<float>(dem.width(), dem.height(), 0.F);
  progress.advance(1.0);
  RuleIce made;
  if (has_ice) {
    const std::vector<IceEntry> entries =
        around != nullptr ? find_ice_entries(*around, dem) : std::vector<IceEntry>();
    made = flowing_ice(evaluate_term(run, static_cast<std::size_t>(balance - rules.terms.begin())),
                       dem, entries);
    run.inputs[ice] = std::move(made.covered);
  } else if (needed[ice]) {
    run.inputs[ice] = Grid<float>(dem.width(), dem.height(), 0.F);
  }
  if (around != nullptr) {
    const Grid<float> share =
        own_share(*given.around, dem.transform, dem.width(), dem.height(), seed);
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

RuleGround see_rule_ground(const ClassRules& rules, const ClassRuleParameters& given,
                           const Dem& dem) {
  const Parameters parameters = all_parameters(rules, given, dem);
  const RuleProgram program = compile_rules(rules, parameters, rules.name, {});
  Run run{rules, program, dem, given.seed, given.climate, {}};
  Catchments own(dem);
  RuleIce ice =
      make_inputs(run, parameters, given, given.catchments != nullptr ? *given.catchments : own,
                  silent_progress());
  return seen_by(std::move(run), std::move(ice));
}

LandCover apply_class_rules(const ClassRules& rules, const ClassRuleParameters& given,
                            const Dem& dem, Progress& progress, RuleGround* seen) {
  const Parameters parameters = all_parameters(rules, given, dem);
  const RuleProgram program = compile_rules(rules, parameters, rules.name, {});
  progress.begin("class rules", 4.0);
  Run run{rules, program, dem, given.seed, given.climate, {}};
  Catchments own(dem);
  Catchments& waters = given.catchments != nullptr ? *given.catchments : own;
  RuleIce made_ice = make_inputs(run, parameters, given, waters, progress);

  // Layers that need rock uphill are applied after the rock.
  Grid<LandCoverClass> classes(dem.width(), dem.height(), LandCoverClass::sky);
  std::size_t first = 0;
  while (first < rules.layers.size() && !program.needs[first][below_rock]) ++first;
  apply_layers(run, 0, first, classes);
  if (first < rules.layers.size()) {
    run.inputs[below_rock] = rock_above(classes, dem, parameter_or(parameters, "apron_m", 400.0));
    apply_layers(run, first, rules.layers.size(), classes);
  }
  progress.advance(1.0);
  remove_specks(classes, static_cast<int>(parameter_or(parameters, "speck_cells", 5.0)));
  progress.advance(1.0);
  LandCover cover{{std::move(classes), dem.transform, dem.crs}};
  if (given.rivers && program.conditions.back())
    cover.inferred_rivers = infer_rivers(run, waters.km2(), cover.classes.cells);
  if (seen != nullptr) *seen = seen_by(std::move(run), std::move(made_ice));
  return cover;
}

std::vector<TownSite> find_rule_towns(const ClassRules& rules, const ClassRuleParameters& given,
                                      const Dem& dem) {
  const Parameters parameters = all_parameters(rules, given, dem);
  const RuleProgram program = compile_rules(rules, parameters, rules.name, {});
  std::vector<TownSite> found;
  if (!program.needs_of(0, rules.layers.size())[town]) return found;
  std::vector<bool> needed(first_class, false);
  for (const int variable : {town, slope, valley_floor})
    needed[static_cast<std::size_t>(variable)] = true;
  make_terrain_inputs(dem, needed, parameters, {given.towns, given.seed}, given.sea, given.climate,
                      given.catchments, &found);
  return found;
}

ClassRuleParameters parameters_for_parts(const ClassRules& rules, const ClassRuleParameters& given,
                                         const Dem& whole) {
  ClassRuleParameters parts = given;
  parts.settings = all_parameters(rules, given, whole);
  if (!parts.sites) parts.sites = find_rule_towns(rules, parts, whole);
  parts.catchments = nullptr;
  return parts;
}

}  // namespace belvedere
