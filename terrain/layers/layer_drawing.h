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
  double power = 2.0;  // 1…4: exponent that sharpens shares, with mean shares kept; at 1 the result
                       // is as speckled as the shares
  double finest_cells = 0.5;  // 0.3…8: standard deviation of the finest octave of the noise, cells
  int octaves = 6;            // 1…10, each twice as long as the previous
  double spectrum = 0.0;      // 0…4: the weight of an octave is its length to half of this; large
                              // values give large patches with smooth borders
  std::uint64_t seed = 1;
};
// Throws Error(usage) naming the parameter that is out of range.
void check_layer_drawing(const LayerDrawingParameters& parameters);

// Parameters and the sharpening of the whole region: a factor for each class that keeps mean
// shares.
struct LayerDrawing {
  LayerDrawingParameters parameters;
  std::array<float, static_cast<std::size_t>(land_cover_class_count)> factor{};
};
// From samples of the region: shares of the classes by their numbers, grids of one size
// (class_shares); [0], ground without a class, is not drawn.
LayerDrawing plan_layer_drawing(const LayerDrawingParameters& parameters,
                                const std::vector<Grid<float>>& samples);

// A class for each cell: the largest of ln(share) + Gumbel noise. The noise of each class is a
// smooth Gaussian field transformed pointwise to Gumbel's distribution. Whatever its correlation,
// the frequency of a class equals its (sharpened) share. sky where no class has any. Any rectangles
// give the same bits.
Grid<LandCoverClass> draw_classes(const LayerDrawing& drawing,
                                  const std::vector<Grid<float>>& shares,
                                  const GeoTransform& transform, const PixelRect& cells);

}  // namespace belvedere
