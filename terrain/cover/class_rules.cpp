#include "terrain/cover/class_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "base/error.h"
#include "base/filter.h"
#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/rising_queue.h"
#include "terrain/cover/class_rules_inputs.h"
#include "terrain/cover/rule_expression.h"
#include "terrain/shape/inferred_rivers.h"

namespace belvedere {

namespace class_rules {

namespace {

constexpr float lasting_balance = -8.F;    // no ice below this balance
constexpr double widest_stream_m = 900.0;  // of ice, on each side
constexpr float min_stream_km2 = 0.02F;    // smaller streams are dropped

constexpr std::array<glm::ivec2, 8> around_cell = {
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

// Flow directions of ice from a cell: to all lower neighbours, more to the steeper ones (Freeman
// 1991).
struct Downhill {
  std::array<float, 8> shares{};  // in the order of around_cell, of `total`
  float total = 0.F;
};
Downhill downhill(const Grid<float>& surface, int x, int y) {
  Downhill down;
  const float here = surface(x, y);
  for (std::size_t k = 0; k < around_cell.size(); ++k) {
    const glm::ivec2 step = around_cell[k];
    if (!surface.contains(x + step.x, y + step.y)) continue;
    const float drop = here - surface(x + step.x, y + step.y);
    const float steep = step.x != 0 && step.y != 0 ? drop * 0.7071F : drop;
    // To the power 1.25, within Freeman's range, as two square roots: fast and equally rounded on
    // every machine.
    if (drop > 0.F) down.shares[k] = steep * std::sqrt(std::sqrt(steep));
    down.total += down.shares[k];
  }
  return down;
}

}  // namespace

RuleIce flowing_ice(const Grid<float>& balance, const Dem& dem,
                    const std::vector<IceEntry>& entries) {
  const int width = dem.width();
  const int height = dem.height();
  const double cell = dem.cell_m();
  // Smoothed: ice does not follow every gully of its bed.
  Grid<float> surface = gaussian_blur(dem.altitude_m, 90.0 / cell);
  // Highest first, equal ones in the order of their cells.
  std::vector<std::uint64_t> falling;
  for (std::size_t i = 0; i < balance.size(); ++i)
    if (balance[i] > lasting_balance)
      falling.push_back(rising_key(-surface[i], static_cast<std::uint32_t>(i)));
  std::sort(falling.begin(), falling.end());

  // In km² of snow field.
  const auto own = static_cast<float>(cell * cell * 1e-6);
  Grid<float> flux(width, height, 0.F);
  for (const IceEntry& entry : entries) flux[static_cast<std::size_t>(entry.cell)] += entry.km2;
  for (const std::uint64_t key : falling) {
    const auto i = static_cast<std::int32_t>(key & 0xffffffffU);
    const auto here = static_cast<std::size_t>(i);
    flux[here] = std::max(0.F, flux[here] + own * std::min(balance[here], 1.F));
    if (flux[here] <= 0.F) continue;
    const Downhill down = downhill(surface, i % width, i / width);
    if (down.total <= 0.F) continue;
    for (std::size_t k = 0; k < down.shares.size(); ++k)
      if (down.shares[k] > 0.F)
        flux(i % width + around_cell[k].x, i / width + around_cell[k].y) +=
            flux[here] * down.shares[k] / down.total;
  }

  falling = {};

  // The thickness of a stream grows with its flow; it covers the neighbouring bed up to its level.
  struct IceStream {
    int x;
    int reach;  // cells
    float level_m;
  };
  std::vector<std::vector<IceStream>> streams(static_cast<std::size_t>(height));  // of each row
  parallel_rows(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const float f = flux(x, y);
      if (f < min_stream_km2 || !(balance(x, y) > lasting_balance)) continue;
      const auto thickness = static_cast<float>(45.0 * exact::pow(f, 0.3));
      const int reach = static_cast<int>(
          std::min(widest_stream_m, 420.0 * std::sqrt(static_cast<double>(f))) / cell);
      streams[static_cast<std::size_t>(y)].push_back({x, reach, surface(x, y) + thickness});
    }
  });
  Grid<float> covered(width, height, 0.F);
  const int farthest = static_cast<int>(widest_stream_m / cell);
  parallel_rows(height, [&](int y) {
    const float* bed = dem.altitude_m.row(y);
    const float* melts = balance.row(y);
    float* out = covered.row(y);
    for (int cy = std::max(0, y - farthest); cy < std::min(height, y + farthest + 1); ++cy) {
      const int dy = y - cy;
      for (const IceStream& stream : streams[static_cast<std::size_t>(cy)]) {
        const int left = stream.reach * stream.reach - dy * dy;
        if (left < 0) continue;
        int half = static_cast<int>(std::sqrt(static_cast<float>(left)));
        while (half * half > left) --half;
        while ((half + 1) * (half + 1) <= left) ++half;
        const int end = std::min(width, stream.x + half + 1);
        for (int x = std::max(0, stream.x - half); x < end; ++x)
          out[x] = ((bed[x] < stream.level_m) & (melts[x] > lasting_balance)) != 0 ? 1.F : out[x];
      }
    }
  });
  return {gaussian_blur(covered, 60.0 / cell), std::move(flux), std::move(surface)};
}

std::vector<IceEntry> find_ice_entries(const RuleGround& around, const Dem& window) {
  std::vector<IceEntry> entries;
  const Grid<float>& flux = around.ice_km2;
  if (flux.empty()) return entries;
  // Cells of the surrounding ground whose centres lie in the window.
  const auto cell_at = [&](double column, double row) {
    const glm::dvec2 position = window.transform.to_crs(column, row);
    return around.transform.to_cell(position.x, position.y);
  };
  const glm::dvec2 first = cell_at(0.0, 0.0);
  const glm::dvec2 last = cell_at(window.width() - 1.0, window.height() - 1.0);
  constexpr double close = 1e-3;
  const PixelRect inside = {static_cast<int>(std::ceil(first.x - close)),
                            static_cast<int>(std::ceil(first.y - close)),
                            static_cast<int>(std::floor(last.x + close)) + 1,
                            static_cast<int>(std::floor(last.y + close)) + 1};
  const int factor =
      static_cast<int>(std::lround(around.transform.cell_x / window.transform.cell_x));
  const auto look = [&](int x, int y) {  // visits a cell outside, next to the window
    if (!flux.contains(x, y) || flux(x, y) < min_stream_km2) return;
    const Downhill down = downhill(around.ice_surface_m, x, y);
    for (std::size_t k = 0; k < around_cell.size(); ++k) {
      const glm::ivec2 next = glm::ivec2(x, y) + around_cell[k];
      if (!(down.shares[k] > 0.F) || next.x < inside.x0 || next.y < inside.y0 ||
          next.x >= inside.x1 || next.y >= inside.y1)
        continue;
      // It flows to the lowest ground nearby.
      const glm::dvec2 position = around.transform.to_crs(next.x, next.y);
      const glm::ivec2 centre(glm::round(window.transform.to_cell(position.x, position.y)));
      glm::ivec2 lowest(std::clamp(centre.x, 0, window.width() - 1),
                        std::clamp(centre.y, 0, window.height() - 1));
      for (int v = -factor / 2; v <= factor / 2; ++v)
        for (int u = -factor / 2; u <= factor / 2; ++u)
          if (const glm::ivec2 other = centre + glm::ivec2(u, v);
              window.altitude_m.contains(other.x, other.y) &&
              window.altitude_m(other.x, other.y) < window.altitude_m(lowest.x, lowest.y))
            lowest = other;
      entries.push_back(
          {lowest.y * window.width() + lowest.x, flux(x, y) * down.shares[k] / down.total});
    }
  };
  for (int x = inside.x0 - 1; x <= inside.x1; ++x) look(x, inside.y0 - 1), look(x, inside.y1);
  for (int y = inside.y0; y < inside.y1; ++y) look(inside.x0 - 1, y), look(inside.x1, y);
  return entries;
}

}  // namespace class_rules

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
