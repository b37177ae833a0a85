#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/pixel_rect.h"
#include "terrain/io/raster.h"
#include "terrain/layers/layer_expressions.h"
#include "terrain/layers/surface_layers.h"

namespace belvedere {

// Surface layers ready to be evaluated.
struct LayerProgram {
  // 256 samples, each with the way to the next; places between them are linear.
  struct Table {
    std::array<std::array<float, 2>, 256> samples{};
  };
  SurfaceLayers layers;
  RuleProgram expressions;
  std::vector<std::string> inputs;         // what evaluation wants, by name: those of the file, then what only expressions read
  std::vector<int> input_of_slot;          // where the variables of expressions stand among them, or -1
  std::vector<std::vector<int>> table_of;  // of each layer and input of the file: its table, or -1
  std::vector<Table> tables;
  std::vector<bool> paints;  // all layers of a product; of an additive model those without children
};
// Error(usage) as check_surface_layers.
LayerProgram compile_layers(const SurfaceLayers& layers);

// Coverage C of each layer, 0…1 and never more than its parent's, at the cells of a rectangle of a raster. `inputs` are grids of its size,
// one for each name of the program's. A pure function of the inputs and the places, so any rectangles and threads give the same bits; and
// up to noise shorter than a cell the mean of a finer raster.
std::vector<Grid<float>> layer_coverage(const LayerProgram& program, const std::vector<Grid<float>>& inputs, const GeoTransform& transform,
                                        const PixelRect& cells, std::uint64_t seed);

// The same, and the bumps of the layers: H' = H + C · roughness · D with D of each layer's own noise, layer by layer. `height_m` holds the
// ground at the rectangle's cells and gets what lies on it. In a product later layers see the altitude with the bumps of those before.
std::vector<Grid<float>> layer_coverage_and_height(const LayerProgram& program, const std::vector<Grid<float>>& inputs,
                                                   const GeoTransform& transform, const PixelRect& cells, std::uint64_t seed,
                                                   Grid<float>& height_m);

// What is seen of the ground and of each layer when all are painted over each other, RGB' = (1 - C) RGB + C RGB of the layer: the ground
// first, then the layers; together 1.
std::vector<Grid<float>> layer_shares(const LayerProgram& program, const std::vector<Grid<float>>& coverage);
// The colour that this gives, sRGB as encoded, 0…255. Dry: without what is painted as water, the ground under it.
enum class LayersShown { all, dry };
Grid<glm::vec3> layer_colour(const LayerProgram& program, const std::vector<Grid<float>>& coverage, LayersShown shown = LayersShown::all);
// Shares of what is painted as each class, by the class's number; [0] is what has no class.
std::vector<Grid<float>> class_shares(const LayerProgram& program, const std::vector<Grid<float>>& shares);

// How much of some ground lies outside the range that a file's functions know: a share for each input of the file, 0…1, of the cells given.
std::vector<double> share_outside(const LayerProgram& program, const std::vector<Grid<float>>& inputs);

}  // namespace belvedere
