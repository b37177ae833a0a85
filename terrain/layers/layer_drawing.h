#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/land_cover_class.h"
#include "base/pixel_rect.h"
#include "terrain/io/raster.h"

namespace belvedere {

// How classes are drawn from shares.
struct LayerDrawingParameters {
  double power = 2.0;         // 1…4: shares are sharpened by it, mean shares kept; 1 is as speckled as shares say
  double finest_cells = 0.5;  // 0.3…8: deviation of the finest octave of the noise, cells
  int octaves = 6;            // 1…10, each twice as long as the one before
  double spectrum = 0.0;      // 0…4: the weight of an octave is its length to half of this; large for large patches with smooth borders
  std::uint64_t seed = 1;
};
// Throws Error(usage) naming the parameter that is out of range.
void check_layer_drawing(const LayerDrawingParameters& parameters);

// Parameters and what sharpening takes from the whole region: a factor for each class, so that mean shares stay.
struct LayerDrawing {
  LayerDrawingParameters parameters;
  std::array<float, static_cast<std::size_t>(land_cover_class_count)> factor{};
};
// From samples of the region: shares of the classes by their numbers, grids of one size (class_shares); [0], what has no class, is not
// drawn.
LayerDrawing plan_layer_drawing(const LayerDrawingParameters& parameters, const std::vector<Grid<float>>& samples);

// A class at each cell: the largest of ln(share) + Gumbel noise, where the noise of each class is a smooth Gaussian field turned into
// Gumbel's distribution place by place. Whatever its correlation, a class comes up as often as its (sharpened) share says. sky where no
// class has any. Any rectangles give the same bits.
Grid<LandCoverClass> draw_classes(const LayerDrawing& drawing, const std::vector<Grid<float>>& shares, const GeoTransform& transform,
                                  const PixelRect& cells);

}  // namespace belvedere
