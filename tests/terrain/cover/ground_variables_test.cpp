#include "terrain/cover/ground_variables.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "terrain/cover/class_rules.h"
#include "terrain/cover/class_rules_inputs.h"
#include "terrain/cover/layer_inputs.h"
#include "tests/files.h"
#include "tests/paths.h"
#include "tests/terrain/cover/class_rules_ground.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

// The table as in docs/class_rules.md.
std::string describe_ground_variables() {
  const auto who = [](const GroundVariable& row) {
    if (row.known_to == KnownTo::rules) return "rules";
    if (row.input == LayerInputKind::none) return "rules, layers";
    return row.known_to == KnownTo::layers ? "layers, functions" : "rules, layers, functions";
  };
  std::string out = "| name | unit | meaning | available in |\n|---|---|---|---|\n";
  for (const GroundVariable& row : ground_variables())
    out += fmt::format("| `{}` | {} | {} | {} |\n", row.name, row.unit, row.meaning, who(row));
  return out;
}

TEST(GroundVariables, TheDocumentHasTheTable) {
  EXPECT_THAT(test::read_bytes(test::source_folder() + "/docs/class_rules.md"),
              HasSubstr("\n\n" + describe_ground_variables() + "\n"))
      << "put this table into docs/class_rules.md:\n"
      << describe_ground_variables();
}

TEST(GroundVariables, EachNameOnceAndSlotsOfRulesInItsOrder) {
  std::set<std::string_view> names;
  for (const GroundVariable& row : ground_variables())
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
  const std::vector<std::string>& slots = class_rules::variable_names();
  namespace rules = class_rules;
  for (const auto& [slot, name] :
       std::vector<std::pair<int, std::string>>{{rules::altitude, "altitude"},
                                                {rules::slope_smooth, "slope_smooth"},
                                                {rules::south, "south"},
                                                {rules::relief_1800, "relief_1800"},
                                                {rules::valley_height, "valley_height"},
                                                {rules::roughness, "roughness"},
                                                {rules::sun, "sun"},
                                                {rules::coast, "coast"},
                                                {rules::riverside, "riverside"},
                                                {rules::ice, "ice"},
                                                {rules::below_rock, "below_rock"},
                                                {rules::n60, "n60"},
                                                {rules::n1800, "n1800"},
                                                {rules::northing, "northing"},
                                                {rules::treeline, "treeline"},
                                                {rules::season_snow, "season_snow"},
                                                {rules::rain, "rain"},
                                                {rules::sky_view, ""},
                                                {rules::first_class, "is_sky"}})
    EXPECT_EQ(slots[static_cast<std::size_t>(slot)], name);
}

// Shared variables of rules and layers agree cell by cell. (Wide means use blocks in layers, so
// that they do not need the whole: a cell at the exact threshold may fall on either side.)
TEST(GroundVariables, AWordMeansTheSameToRulesAndLayers) {
  const Dem dem = test::ground(260, [](double e, double n) {
    return 1200.0 + 300.0 * std::sin(e / 500.0) * std::cos(n / 650.0) + 0.1 * e +
           25.0 * std::sin(e / 70.0 + n / 110.0);
  });
  for (const std::string& name : layer_input_names()) {
    if (layer_input_kind(name) >= LayerInputKind::temperature)
      continue;                     // given by the climate, not by the ground
    if (name == "south") continue;  // rules fade it out on flatter ground
    const Grid<float> grid = layer_inputs(make_layer_ground(dem, {}, {name})).front();
    for (const double share : {0.2, 0.5, 0.9}) {
      std::vector<float> sorted(grid.begin(), grid.end());
      std::sort(sorted.begin(), sorted.end());
      const float threshold =
          sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
      const ClassRules rules{
          "one",
          {{"speck_cells", 0.0}, {"threshold", static_cast<double>(threshold)}},
          {},
          {{LandCoverClass::forest, "1"}, {LandCoverClass::rock, name + " > threshold"}}};
      const Grid<LandCoverClass> classes =
          apply_class_rules(rules, {}, dem, silent_progress()).classes.cells;
      std::size_t differ = 0;
      for (std::size_t i = 0; i < grid.size(); ++i)
        differ += (classes[i] == LandCoverClass::rock) == (grid[i] > threshold) ? 0 : 1;
      EXPECT_LE(differ, grid.size() / 100) << name << " > " << threshold;
    }
  }
}

}  // namespace
}  // namespace belvedere
