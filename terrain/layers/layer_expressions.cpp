#include "terrain/layers/layer_expressions.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "terrain/cover/ground_variables.h"
#include "terrain/cover/rule_program.h"

namespace belvedere {

RuleProgram compile_layer_expressions(const SurfaceLayers& layers, const std::string& where,
                                      const RulePlaces& positions) {
  std::vector<RuleCondition> conditions;
  for (const SurfaceLayer& layer : layers.layers)
    conditions.push_back({layer.when, "layer " + layer.name});
  return compile_expressions(expression_names(KnownTo::layers), layers.parameters, layers.terms,
                             conditions, where, positions);
}

std::vector<Grid<std::uint8_t>> evaluate_layer_expressions(
    const RuleProgram& program, const std::vector<const Grid<float>*>& grids,
    const GeoTransform& transform, const PixelRect& cells, std::uint64_t seed) {
  std::vector<Grid<std::uint8_t>> out(program.conditions.size());
  for (std::size_t k = 0; k < out.size(); ++k)
    if (program.conditions[k]) out[k] = Grid<std::uint8_t>(cells.width(), cells.height());
  const RuleGrids known(program, program.all_needs(), transform, cells, seed, grids);
  RuleRows rows(known);
  std::array<float, rule_block> result{};
  for (int y = 0; y < cells.height(); ++y) {
    rows.start(y);
    for (int begin = 0; begin < cells.width(); begin += rule_block) {
      const int count = std::min(rule_block, cells.width() - begin);
      rows.go_to(begin);
      for (std::size_t k = 0; k < out.size(); ++k) {
        if (!program.conditions[k]) continue;
        rows.evaluate(*program.conditions[k], result.data());
        std::uint8_t* target = out[k].row(y) + begin;
        for (int x = 0; x < count; ++x)
          target[x] = result[static_cast<std::size_t>(x)] > 0.F ? 1 : 0;
      }
    }
  }
  return out;
}

}  // namespace belvedere
