#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/progress.h"
#include "terrain/cover/land_cover.h"
#include "terrain/io/dem.h"

namespace belvedere {

// Land cover for a DEM that has none, from rules in a file of their own (data/layers/alpine.toml): surface layers in order, each with a
// class and conditions over altitude, slope, exposure, relief, noise and water; later layers win (look/recipe.md, Classes; requirements
// P02). docs/class_rules.md describes the file and the variables.
struct ClassRules {
  struct Layer {
    LandCoverClass painted_as;
    std::string when;  // an expression (terrain/cover/rule_expression.h); true where > 0
  };
  std::string name;
  std::vector<std::pair<std::string, double>> parameters;  // named numbers that expressions may use and a scene may set
  std::vector<std::pair<std::string, std::string>> terms;  // named sub-expressions, evaluated in order
  std::vector<Layer> layers;
};

// Built-in name ("alpine") or a .toml file. Every expression is checked: Error(usage) with file:line:column and the nearest known name.
ClassRules read_class_rules(const std::string& name_or_path);

// Evaluates the rules on the DEM's grid, cleans up specks, and returns land cover; cells that no layer covers take the nearest class.
// `settings` override the rules' parameters by name; Error(usage) for an unknown one, with the nearest known.
// Noise depends on `seed` and the place in the CRS alone, so a part of a DEM gets the same ragged treelines as the whole.
LandCover apply_class_rules(const ClassRules& rules, const std::vector<std::pair<std::string, double>>& settings, const Dem& dem,
                            std::uint64_t seed, Progress& progress);

}  // namespace belvedere
