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
#include "terrain/layers/layer_picture.h"
#include "terrain/layers/surface_layers.h"

namespace belvedere {

struct LayerApplyParameters {
  std::uint64_t seed = 1;  // of the layers' noise and of drawing
  LayerDrawingParameters drawing;
  bool colour = false;    // make colours
  bool coverage = false;  // make coverages
  bool relief = false;    // of land cover: the bumps of layers and the lake beds; then colours are
                          // those of dry ground
  // For a window: the larger terrain that contains it, and how classes are drawn there
  // (plan_drawing).
  const Dem* whole = nullptr;
  std::optional<LayerDrawing> drawn = {};
};

// Rows of the result, the DEM's whole width.
struct LayerStrip {
  int y0 = 0;
  Grid<LandCoverClass> classes;            // sky: no class
  std::vector<Grid<std::uint8_t>> colour;  // red, green, blue, sRGB; empty if not requested
  std::vector<Grid<std::uint8_t>>
      coverage;                    // of each layer, C · 255 rounded; empty if not requested
  std::vector<Grid<float>> bumps;  // C of each rough layer, in their order; likewise
};

struct LayerApplyResult {
  std::vector<double>
      outside;  // for each input of the file: the share of the ground outside its range, 0…1
  std::array<double, static_cast<std::size_t>(land_cover_class_count)>
      class_share{};  // of the ground; [0] is ground without a class
  // Inputs with a larger share outside their range are reported.
  static constexpr double much = 0.10;
};

// Applies surface layers to a DEM, in strips of rows from the top down, so that only the DEM need
// fit into memory. Classes are drawn from the visible shares. The same bits for any threads.
// Error(usage) if an input is missing.
LayerApplyResult apply_layers(const SurfaceLayers& layers, const Dem& dem,
                              const LayerClimate& climate, const LayerApplyParameters& parameters,
                              const std::function<void(const LayerStrip&)>& take,
                              Progress& progress);

// How classes are drawn on a DEM, for windows of it.
LayerDrawing plan_drawing(const SurfaceLayers& layers, const Dem& dem, const LayerClimate& climate,
                          const LayerApplyParameters& parameters);

// The classes as land cover, with colours and relief if requested; cells that no class covers take
// the nearest. Notes inputs outside their ranges. Error(usage) for layers without any class.
LandCover layer_land_cover(const SurfaceLayers& layers, const Dem& dem, const LayerClimate& climate,
                           const LayerApplyParameters& parameters, Progress& progress);

// A line for each input that is often outside its range.
std::vector<std::string> range_warnings(const SurfaceLayers& layers,
                                        const LayerApplyResult& result);

}  // namespace belvedere
