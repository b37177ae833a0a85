#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/pixel_rect.h"
#include "terrain/cover/rule_program.h"
#include "terrain/io/raster.h"
#include "terrain/layers/surface_layers.h"

namespace belvedere {

// The compiled expressions of a file of layers: a condition for each layer. They may use every
// input of the table, noise of 60, 210, 660 and 1800 m (n60 …, mean 0, standard deviation 1),
// parameters and earlier terms. Error(usage) with the position of the error.
RuleProgram compile_layer_expressions(const SurfaceLayers& layers, const std::string& where,
                                      const RulePlaces& positions = {});

// 1 where a layer's expression is true, 0 where it is not, at the cells of a rectangle; empty for
// layers without one. `grids` by slot, of the rectangle's size: those that the program needs.
std::vector<Grid<std::uint8_t>> evaluate_layer_expressions(
    const RuleProgram& program, const std::vector<const Grid<float>*>& grids,
    const GeoTransform& transform, const PixelRect& cells, std::uint64_t seed);

}  // namespace belvedere
