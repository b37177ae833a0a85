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
#include "base/pixel_rect.h"
#include "base/random.h"
#include "terrain/cover/rule_expression.h"
#include "terrain/io/raster.h"

namespace belvedere {

// Land cover for a DEM without a land-cover raster, from rules in a file
// (data/layers/life_zones.toml): layers in order, each with a class and conditions over altitude,
// slope, exposure, relief, climate, noise and water; later layers win. docs/class_rules.md
// describes the file and the variables.
struct ClassRules {
  struct Layer {
    LandCoverClass painted_as;
    std::string when;  // an expression (terrain/cover/rule_expression.h); true where > 0
  };
  std::string name;
  std::vector<std::pair<std::string, double>>
      parameters;  // named numbers for expressions; a scene may set them
  std::vector<std::pair<std::string, std::string>>
      terms;  // named sub-expressions, evaluated in order
  std::vector<Layer> layers;
  std::string rivers = {};  // an expression: inferred rivers run as lines where it is > 0; none:
                            // only `river` decides
};

// Built-in name ("life_zones") or a .toml file. Every expression is checked: Error(usage) with
// file:line:column and the closest known name.
ClassRules read_class_rules(const std::string& name_or_path);

// Whether the rules use a variable of docs/class_rules.md, directly or through a term.
bool uses_variable(const ClassRules& rules, const std::string& variable);

// Whether a name is one of the former town parameters: town_1_east, town_1_north, town_1_radius_m,
// town_2_…
bool names_old_town(const std::string& parameter);

// The term for the snow balance, from which ice is computed.
inline constexpr char ice_balance_term[] = "ice_balance";

// Positions of the texts of a file of layers; empty for what does not come from a file.
struct RulePlaces {
  std::vector<ConfigPosition> terms;
  std::vector<ConfigPosition> conditions;
};
struct RuleCondition {
  std::string text;  // an expression, true where > 0; empty: none
  std::string what;  // for messages if it has no position
};

// The compiled expressions of class rules or surface layers. Slots: those of expression_names, then
// the terms.
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
// Error(usage) at the position of an invalid expression. `variables` by slot; `where`: the file,
// for messages.
RuleProgram compile_expressions(const std::vector<std::string>& variables,
                                const NamedNumbers& parameters,
                                const std::vector<std::pair<std::string, std::string>>& terms,
                                const std::vector<RuleCondition>& conditions,
                                const std::string& where, const RulePlaces& positions);

// The same for class rules: the conditions of their layers, then that of rivers. Error(usage) also
// if a text uses a variable that is not available there.
RuleProgram compile_rules(const ClassRules& rules, const NamedNumbers& parameters,
                          const std::string& where, const RulePlaces& positions);

// The parameters of `whose` with other values; Error(usage) for an unknown name, with the closest
// one.
NamedNumbers with_settings(NamedNumbers parameters, const NamedNumbers& settings,
                           const std::string& whose);

// Data for the expressions of a program: a rectangle of a raster, and the values of its cells by
// slot.
struct RuleGrids {
  // Variables that are not grids: a row of the rectangle, made on demand.
  using Fill = std::function<void(std::size_t slot, int y, float* out)>;

  // `needed` by slot, as needs of the program; `grids` have the rectangle's size, null if absent.
  // Noise is built in.
  RuleGrids(const RuleProgram& program, std::vector<bool> needed, const GeoTransform& transform,
            const PixelRect& cells, std::uint64_t seed, std::vector<const Grid<float>*> grids,
            Fill fill = {});

  const RuleProgram& program;
  std::vector<bool> needed;
  GeoTransform transform;
  PixelRect cells;
  std::uint64_t seed;
  std::vector<const Grid<float>*> grids;
  Fill fill;
  std::vector<NoiseColumns> noise;  // of the slots that are noise
};

// Iterates over its rows, for one thread: the same bits for any rectangle that contains a cell.
class RuleRows {
 public:
  explicit RuleRows(const RuleGrids& grids);

  // Makes the needed variables of row y of the rectangle. Terms come last, in their order.
  void start(int y);
  // Moves to the cells begin … begin + rule_block - 1 of the row; values beyond the rectangle are
  // undefined.
  void go_to(int begin);
  // Writes rule_block values.
  void evaluate(const RuleExpression& expression, float* out) {
    expression.evaluate(pointers_, out, scratch_);
  }
  // The whole row of a needed slot that is not a grid, for reading or changing.
  float* row(std::size_t slot) { return rows_[slot].data(); }

 private:
  const RuleGrids& of_;
  int y_ = 0;
  std::vector<std::vector<float>> rows_;  // whole blocks long
  std::vector<const float*> pointers_;
  RuleExpression::Scratch scratch_;
};

}  // namespace belvedere
