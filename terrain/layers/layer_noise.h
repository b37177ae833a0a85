#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "base/pixel_rect.h"
#include "terrain/io/raster.h"
#include "terrain/layers/surface_layers.h"

namespace belvedere {

// Noise of surface layers in -1…1, mean 0, a function of seed and place in the CRS alone: octaves of hashed lattice values under a cubic
// B-spline, each of half the length and half the weight of the one before. Octaves shorter than a cell are left out, those of one to
// two cells fade in, so that a coarse raster is the mean of a fine one and not a draw of it.
// N = clamp(2 Σ w n / Σ w, -1, 1), Σ w over all octaves of the layer: the factor brings the deviation to about a third.
class LayerNoiseRows {
 public:
  LayerNoiseRows(const LayerNoise& noise, std::uint64_t seed, const GeoTransform& transform, const PixelRect& cells);

  // A smooth Gaussian field instead, of deviation 1 at every place and without bounds: octaves of normal lattice values. The squares of
  // the weights sum to 1.
  struct GaussianOctave {
    double sigma_m = 1.0;  // as gaussian_noise: the lattice's spacing over √3
    double weight = 1.0;
    std::uint64_t seed = 0;
  };
  LayerNoiseRows(const std::vector<GaussianOctave>& octaves, const GeoTransform& transform, const PixelRect& cells);

  // The row `y` of the raster, in cells.y0…cells.y1, at the columns of the rectangle.
  void fill(int y, float* out);

 private:
  struct Octave {
    double spacing_m = 1.0;
    float weight = 0.F;  // with the factor and Σ w in it
    std::uint64_t seed = 0;
    std::int64_t first_column = 0;  // of the lattice
    std::vector<std::int32_t> at;   // of each cell: the first of four lattice columns, from first_column on
    std::vector<std::array<float, 4>> weights;
    std::vector<float> lattice[4];  // four rows of lattice values
    std::int64_t first_row = 0;     // that the four begin at
    bool filled = false;
    std::vector<float> line;  // the four rows at the height of the row
  };
  void add_octave(double spacing_m, double weight, std::uint64_t seed);

  GeoTransform transform_;
  PixelRect cells_;
  bool gaussian_ = false;
  std::vector<Octave> octaves_;
};

// The same noise at one place of the CRS, as a raster of cells of cell_m has it there, and how it rises a metre east and north.
struct NoiseAtPlace {
  double value = 0.0;
  glm::dvec2 slope{0.0};
};
NoiseAtPlace layer_noise_at(const LayerNoise& noise, std::uint64_t seed, glm::dvec2 place_m, double cell_m);

}  // namespace belvedere
