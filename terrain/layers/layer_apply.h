#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "terrain/cover/land_cover.h"
#include "terrain/cover/layer_inputs.h"
#include "terrain/io/dem.h"
#include "terrain/layers/layer_drawing.h"
#include "terrain/layers/surface_layers.h"

namespace belvedere {

struct LayerApplyParameters {
  std::uint64_t seed = 1;  // of the layers' noise and of drawing
  LayerDrawingParameters drawing;
  bool colour = false;    // make colours
  bool coverage = false;  // make coverages
  bool relief = false;    // of land cover: the bumps of layers and the beds of lakes; then colours are those of dry ground
  // Of a window: the larger terrain that it is part of, and how classes are drawn there (plan_drawing).
  const Dem* whole = nullptr;
  std::optional<LayerDrawing> drawn = {};
};

// Rows of the result, the DEM's whole width.
struct LayerStrip {
  int y0 = 0;
  Grid<LandCoverClass> classes;              // sky: nothing that has a class
  std::vector<Grid<std::uint8_t>> colour;    // red, green, blue, sRGB; empty where not wanted
  std::vector<Grid<std::uint8_t>> coverage;  // of each layer, C · 255 rounded; empty where not wanted
  std::vector<Grid<float>> bumps;            // C of each layer that is rough, in their order; the same
};

struct LayerApplyResult {
  std::vector<double> outside;  // of each input of the file: the share of the ground outside the range it knows, 0…1
  std::array<double, static_cast<std::size_t>(land_cover_class_count)> class_share{};  // of the ground; [0] is what has no class
  // Inputs of which more than so much lies outside: the layers guess there.
  static constexpr double much = 0.10;
};

// Lays surface layers over a DEM, a strip of rows after the other from the top down, so that only the DEM need fit into memory. Classes are
// drawn from the shares of all that is seen. The same bits for any threads. Error(usage) where an input is missing.
LayerApplyResult apply_layers(const SurfaceLayers& layers, const Dem& dem, const LayerClimate& climate,
                              const LayerApplyParameters& parameters, const std::function<void(const LayerStrip&)>& take,
                              Progress& progress);

// How classes are drawn on a DEM, for windows of it.
LayerDrawing plan_drawing(const SurfaceLayers& layers, const Dem& dem, const LayerClimate& climate, const LayerApplyParameters& parameters);

// The classes as land cover, and where parameters ask for colours and relief these with them; cells that no class covers take the nearest.
// Notes what lies outside of ranges. Error(usage) for layers that have no class at all.
LandCover layer_land_cover(const SurfaceLayers& layers, const Dem& dem, const LayerClimate& climate, const LayerApplyParameters& parameters,
                           Progress& progress);

// A line for each input of which much lies outside its range.
std::vector<std::string> range_warnings(const SurfaceLayers& layers, const LayerApplyResult& result);

}  // namespace belvedere
