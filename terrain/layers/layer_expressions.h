#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/config.h"
#include "base/pixel_rect.h"
#include "terrain/cover/rule_expression.h"
#include "terrain/io/raster.h"
#include "terrain/layers/surface_layers.h"

namespace belvedere {

// The expressions of a file of layers, ready to run. They may name every input of the table, noise of 60, 210, 660 and 1800 m (n60 …, mean
// 0, deviation 1), parameters and the terms before them.
struct LayerExpressions {
  std::vector<std::string> variables;  // by slot: inputs that are read, noises, then the terms
  std::size_t inputs = 0;              // how many of them are inputs
  std::vector<RuleExpression> terms;
  std::vector<std::optional<RuleExpression>> when;  // one for each layer
  bool empty() const { return variables.empty(); }
};
// Where texts stand in their file; empty where there is none.
struct LayerExpressionPlaces {
  std::vector<ConfigPlace> terms;
  std::vector<ConfigPlace> when;
};
// Error(usage) with the place of the fault. Only what is read comes into `variables`.
LayerExpressions compile_layer_expressions(const SurfaceLayers& layers, const std::string& where, const LayerExpressionPlaces& places = {});

// 1 where a layer's expression is true, 0 where it is not, at the cells of a rectangle; empty for layers without one. `inputs` has a grid
// of the rectangle's size for each of the first variables.
std::vector<Grid<std::uint8_t>> evaluate_layer_expressions(const LayerExpressions& expressions,
                                                           const std::vector<const Grid<float>*>& inputs, const GeoTransform& transform,
                                                           const PixelRect& cells, std::uint64_t seed);

}  // namespace belvedere
