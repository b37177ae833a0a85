#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "base/land_cover_class.h"
#include "base/pixel_rect.h"
#include "base/progress.h"
#include "terrain/cover/layer_inputs.h"
#include "terrain/io/raster.h"
#include "terrain/layers/layer_coverage.h"
#include "terrain/layers/layer_noise.h"
#include "terrain/layers/surface_layers.h"

namespace belvedere {

struct LayerPictureParameters {
  int finer = 4;               // subdivisions of a DEM cell along each side, 1…16
  std::uint64_t seed = 1;      // of the layers' noise
  double light_from = 315.0;   // azimuth of the light, degrees clockwise from north
  double light_height = 45.0;  // degrees above the horizon, 5…90
  double shade = 0.35;  // brightness of ground that faces away from the light, 0…1; level ground
                        // has its own colour
  double relief = 1.0;  // factor on slopes for lighting, ≥ 0
  bool beds = true;     // lakes are transparent and show synthetic beds
  LakeBedParameters lakes = {};
};

// Checks the values above. Error(usage).
void check_layer_picture(const LayerPictureParameters& parameters);

// Lighting of slopes with a precomputed light direction.
class SlopeLight {
 public:
  explicit SlopeLight(const LayerPictureParameters& parameters);
  // Brightness of a slope with this unit normal (x east, y north, z up): Lambert's cosine, 1 on
  // level ground, the shade where it faces away.
  float brightness(const glm::vec3& normal) const;

 private:
  glm::dvec3 to_light_;
  double shade_;
  double relief_;
};

// The lit ground with its layers from above: rows of the finer raster from the top down, sRGB as
// encoded, 0…255. Altitudes between cells are interpolated by spline, finer detail comes from the
// layers' noise (layer_surface). In strips; the same bits for any threads. Brightness multiplies
// encoded values, as hillshades are laid over maps. Error(usage) without layers.
void draw_layer_picture(const SurfaceLayers& layers, const Dem& dem, const LayerClimate& climate,
                        const LayerPictureParameters& parameters,
                        const std::function<void(int y0, const Grid<glm::vec3>& rows)>& take,
                        Progress& progress);

// Coefficients whose cubic B-spline interpolates the values at the cells' centres (evaluated by
// sample_bspline): smooth to the second derivative, without facets, and peaks keep their height.
// The impulse response of the recursive prefilter, √3 (√3 - 2)^|k|, is truncated below a float's
// last bit, so that a coefficient depends only on 16 cells around it; borders replicated.
Grid<float> spline_coefficients(const Grid<float>& values);

// Radius in cells that a coefficient depends on.
inline constexpr int spline_reach = 16;

// Layers at the cells of a rectangle: the one evaluation of pictures, classes and scenes.
struct LayeredCells {
  std::vector<Grid<float>> inputs;  // of the ground without bumps, by the program's names
  std::vector<Grid<float>> coverage;
  Grid<float> altitude_m;  // with the layers' bumps
};

// Evaluates layers at `factor` × `factor` positions per cell of the DEM: `cells` is a rectangle of
// that finer raster, which starts where the DEM does. Altitudes and all other inputs between cells
// are interpolated by splines through the values at the cells; finer detail comes from the layers'
// noise. Any rectangle has the bits of the whole.
LayeredCells evaluate_layers(const LayerProgram& program, const LayerGround& ground, int factor,
                             const PixelRect& cells, std::uint64_t seed);

// A piece of ground with its layers.
struct LayerSurface {
  Grid<float> altitude_m;  // with the layers' bumps
  Grid<glm::vec3> normal;  // of that, unit length; x east, y north, z up
  Grid<glm::vec3> colour;  // sRGB as encoded, 0…255
};

// The surface of evaluate_layers().
LayerSurface layer_surface(const LayerProgram& program, const LayerGround& ground, int factor,
                           const PixelRect& cells, std::uint64_t seed);

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
// Plans the drawing from samples of the region: shares of the classes by their numbers, grids of
// one size (class_shares); [0], ground without a class, is not drawn.
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
