#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "base/pixel_rect.h"
#include "terrain/cover/land_cover.h"
#include "terrain/io/dem.h"
#include "terrain/io/raster.h"
#include "terrain/layers/surface_layers.h"
#include "terrain/shape/hydrology.h"

namespace belvedere {

// Noise of surface layers in -1…1, mean 0, a function only of seed and position in the CRS: octaves
// of hashed lattice values under a cubic B-spline, each with half the length and `gain` times the
// weight of the previous. Octaves shorter than a cell are left out, those of one to two cells fade
// in, so that a coarse raster is the mean of a fine one and not a sample of it. N = clamp(2 Σ w n /
// Σ w, -1, 1), Σ w over all octaves of the layer: the factor gives a standard deviation of about a
// third with a gain of ½.
class LayerNoiseRows {
 public:
  LayerNoiseRows(const LayerNoise& noise, std::uint64_t seed, const GeoTransform& transform,
                 const PixelRect& cells);

  // Alternatively a smooth, unbounded Gaussian field of standard deviation 1 everywhere: octaves of
  // normal lattice values. The squares of the weights sum to 1.
  struct GaussianOctave {
    double sigma_m = 1.0;  // as gaussian_noise: the lattice's spacing over √3
    double weight = 1.0;
    std::uint64_t seed = 0;
  };
  LayerNoiseRows(const std::vector<GaussianOctave>& octaves, const GeoTransform& transform,
                 const PixelRect& cells);

  // Row `y` of the raster, in cells.y0…cells.y1, at the columns of the rectangle.
  void fill(int y, float* out);

 private:
  struct Octave {
    double spacing_m = 1.0;
    float weight = 0.F;  // including the factor and Σ w
    std::uint64_t seed = 0;
    std::int64_t first_column = 0;  // of the lattice
    std::vector<std::int32_t>
        at;  // of each cell: the first of four lattice columns, from first_column on
    std::vector<std::array<float, 4>> weights;
    std::vector<float> lattice[4];  // four rows of lattice values
    std::int64_t first_row = 0;     // of the four
    bool filled = false;
    std::vector<float> line;  // the four rows interpolated at the current row
  };
  void add_octave(double spacing_m, double weight, std::uint64_t seed);

  GeoTransform transform_;
  PixelRect cells_;
  bool gaussian_ = false;
  std::vector<Octave> octaves_;
};

// The same noise at one position of the CRS, as for a raster of cells of cell_m, and its gradient
// per metre east and north.
struct NoiseAtPosition {
  double value = 0.0;
  glm::dvec2 slope{0.0};
};
NoiseAtPosition layer_noise_at(const LayerNoise& noise, std::uint64_t seed, glm::dvec2 position_m,
                               double cell_m);

// Relief that surface layers add to the ground: bumps of noise (SurfaceLayer::roughness_m) and lake
// beds. A picture from above raises its raster by them (layer_surface); a picture with arbitrary
// pixel positions queries single positions.

// Hash of a layer's name, for streams of its own.
std::uint64_t seed_of_name(const std::string& name);
// The noise of bumps of this length, between -1 and 1, individual for each layer.
LayerNoise bump_noise(double length_m);
std::uint64_t bump_seed(const SurfaceLayer& layer, std::uint64_t seed);

// Slope of the bumps at a position of the CRS, per metre east and north: the gradient of the sum of
// share · height · noise. Only parts longer than pixel_m (> 0) are included, so that far ground is
// smooth. The mean over level ground is 0.
glm::dvec2 bump_slope(const GroundRelief& relief, glm::dvec2 position_m, double pixel_m);

// A DEM contains only a lake's surface. Synthetic beds from its shape: a bowl that deepens from the
// shore and is deepest where the shore is farthest.
struct LakeBedParameters {
  LakeParameters lakes;
  double shore_slope = 0.16;  // rise over run at the shore; > 0
  double deepest_m = 150.0;   // maximum depth; > 0
};

// Depth of the water at each cell, m; 0 on land. A lake whose farthest position from the shore is
// at distance d has the depth D = min(deepest, slope · d / 2) there, and D (1 - (1 - t)²) at the
// distance t d.
Grid<float> lake_depth_m(const Dem& dem, const LakeBedParameters& parameters = {});

}  // namespace belvedere
