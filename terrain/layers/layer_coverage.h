#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/pixel_rect.h"
#include "terrain/io/raster.h"
#include "terrain/layers/surface_layers.h"

namespace belvedere {

// Surface layers compiled for evaluation.
struct LayerProgram {
  // 256 samples, each with the difference to the next; linear between them.
  struct Table {
    std::array<std::array<float, 2>, 256> samples{};
  };
  SurfaceLayers layers;
  RuleProgram expressions;
  std::vector<std::string>
      inputs;  // names of the inputs needed: those of the file, then those only in expressions
  std::vector<int> input_of_slot;  // index of the variables of expressions among them, or -1
  std::vector<std::vector<int>> table_of;  // of each layer and input of the file: its table, or -1
  std::vector<Table> tables;
  std::vector<bool> paints;  // all layers of a product; in an additive model those without children
};
// Error(usage) as check_surface_layers.
LayerProgram compile_layers(const SurfaceLayers& layers);

// Ground that layers raise by their bumps: H' = H + C · roughness · D with D of each layer's own
// noise, layer by layer. In a product later layers and their expressions use the altitude with the
// bumps of earlier ones, and slope and exposure with the slopes of these bumps.
struct RaisedGround {
  Grid<float> height_m;                       // at the cells; receives the height with bumps
  std::vector<Grid<float>> slope_north_east;  // inputs of these names, without bumps; may be empty
                                              // if handed_on() is 0
};
// Number of rough layers whose bumps reach the slope of later ones at cells of this size: so many
// cells at the edge of a rectangle differ from the whole's, since slopes are differences of
// neighbours. Bumps shorter than a cell are not visible.
int handed_on(const LayerProgram& program, double cell_m);

// Coverage C of each layer, 0…1 and never more than its parent's, at the cells of a rectangle of a
// raster. `inputs` are grids of its size, one for each name of the program's. A pure function of
// inputs and positions, so any rectangles (within handed_on()) and threads give the same bits.
// Except for noise shorter than a cell it is the mean of a finer raster. `raised`: ground of the
// rectangle's size; null: level, without bumps.
std::vector<Grid<float>> layer_coverage(const LayerProgram& program,
                                        const std::vector<Grid<float>>& inputs,
                                        const GeoTransform& transform, const PixelRect& cells,
                                        std::uint64_t seed, RaisedGround* raised = nullptr);

// Visible shares of the ground and of each layer when all are painted in order, RGB' = (1 - C) RGB
// + C RGB of the layer: the ground first, then the layers; their sum is 1.
std::vector<Grid<float>> layer_shares(const LayerProgram& program,
                                      const std::vector<Grid<float>>& coverage);
// The resulting colour, sRGB as encoded, 0…255. Dry: without layers painted as water, so that the
// ground under them shows.
enum class LayersShown { all, dry };
Grid<glm::vec3> layer_colour(const LayerProgram& program, const std::vector<Grid<float>>& coverage,
                             LayersShown shown = LayersShown::all);
// Visible shares of each class, by the class's number; [0] is ground without a class.
std::vector<Grid<float>> class_shares(const LayerProgram& program,
                                      const std::vector<Grid<float>>& shares);

// Share of some ground outside the ranges of a file's functions: for each input of the file, 0…1,
// of the cells given.
std::vector<double> share_outside(const LayerProgram& program,
                                  const std::vector<Grid<float>>& inputs);

}  // namespace belvedere
