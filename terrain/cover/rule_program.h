#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/config.h"
#include "base/grid.h"
#include "base/land_cover_class.h"
#include "base/noise.h"
#include "base/pixel_rect.h"
#include "terrain/cover/rule_expression.h"
#include "terrain/io/raster.h"

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

// Where the texts of a file of layers stand; empty for what comes from no file.
struct RulePlaces {
  std::vector<ConfigPlace> terms;
  std::vector<ConfigPlace> conditions;
};
struct RuleCondition {
  std::string text;  // an expression, true where > 0; empty: none
  std::string what;  // for messages where it has no place
};

// The expressions of class rules or surface layers, ready to run. Slots: those of expression_names, then the terms.
struct RuleProgram {
  std::vector<RuleExpression> terms;
  std::vector<std::optional<RuleExpression>> conditions;
  std::vector<std::vector<bool>> term_needs;  // slots a term reads, also through other terms
  std::vector<std::vector<bool>> needs;       // … a condition
  // Slots that any of the conditions from … to - 1 reads.
  std::vector<bool> needs_of(std::size_t from, std::size_t to) const;
  std::vector<bool> all_needs() const { return needs_of(0, needs.size()); }
};

using NamedNumbers = std::vector<std::pair<std::string, double>>;
// Error(usage) at the place of a text that is no expression. `variables` by slot; `where`: the file, for messages.
RuleProgram compile_expressions(const std::vector<std::string>& variables, const NamedNumbers& parameters,
                                const std::vector<std::pair<std::string, std::string>>& terms, const std::vector<RuleCondition>& conditions,
                                const std::string& where, const RulePlaces& places);

// The same of class rules: the conditions of their layers, then that of rivers. Error(usage) also where a text asks for what is not known
// there.
RuleProgram compile_rules(const ClassRules& rules, const NamedNumbers& parameters, const std::string& where, const RulePlaces& places);

// The parameters of `whose` with other values; Error(usage) for a name that is none of them, with the nearest.
NamedNumbers with_settings(NamedNumbers parameters, const NamedNumbers& settings, const std::string& whose);

// What the expressions of a program are computed on: a rectangle of a raster, and what its cells have by slot.
struct RuleGrids {
  // Grids that are no grids: a row of the rectangle, made when it is asked for.
  using Fill = std::function<void(std::size_t slot, int y, float* out)>;

  // `needed` by slot, as needs of the program; `grids` have the rectangle's size, null where there is none. Noise is known here.
  RuleGrids(const RuleProgram& program, std::vector<bool> needed, const GeoTransform& transform, const PixelRect& cells, std::uint64_t seed,
            std::vector<const Grid<float>*> grids, Fill fill = {});

  const RuleProgram& program;
  std::vector<bool> needed;
  GeoTransform transform;
  PixelRect cells;
  std::uint64_t seed;
  std::vector<const Grid<float>*> grids;
  Fill fill;
  std::vector<NoiseColumns> noise;  // of the slots that are noise
};

// One row after the other of them, for one thread: the same bits for any rectangle that holds a cell.
class RuleRows {
 public:
  explicit RuleRows(const RuleGrids& grids);

  // Makes what is needed of row y of the rectangle. Terms come last, in their order.
  void start(int y);
  // Goes to the cells begin … begin + rule_block - 1 of the row; those beyond the rectangle are of no meaning.
  void go_to(int begin);
  // Writes rule_block values.
  void evaluate(const RuleExpression& expression, float* out) { expression.evaluate(pointers_, out, scratch_); }
  // The whole row of a needed slot that is no grid, to be read or changed.
  float* row(std::size_t slot) { return rows_[slot].data(); }

 private:
  const RuleGrids& of_;
  int y_ = 0;
  std::vector<std::vector<float>> rows_;  // whole blocks long
  std::vector<const float*> pointers_;
  RuleExpression::Scratch scratch_;
};

}  // namespace belvedere
