#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// As in base/random.cpp: the deviation of a B-spline is its spacing / sqrt(3).
constexpr double spacing_per_sigma = 1.7320508075688772;
// A lattice coordinate outside every picture, for empty cache entries.
constexpr std::int64_t nowhere = INT64_MIN;

// The noise of base/random.h evaluated for whole pictures: same values up to float rounding, many
// times faster. Both are pure functions of seed and absolute position, so they do not depend on how
// a picture is split into parts.

// Noise at every pixel of a part of the picture whose top-left pixel is `origin_px`. Widths in
// units of 0.5 mm of the sheet; a unit has `pixels_per_unit` pixels, so the noise is fixed to the
// sheet at every resolution. The lattice is filtered along x, then along y, which costs two sums of
// four per pixel.
Grid<float> make_image_noise(std::uint64_t seed, glm::ivec2 origin_px, int width, int height,
                             double pixels_per_unit, double sigma_x_units, double sigma_y_units);

// Noise about -2…2 on a lattice of spacing 1, linear over the two triangles of a cell, for broken
// instead of curled edges.
float broken_noise(std::uint64_t seed, float x, float y);

// Noise on the ground, in metres. It caches lattice values, for positions close to the previous
// one, as along a row of pixels. Not to be shared between threads.
class GroundNoise {
 public:
  GroundNoise(std::uint64_t seed, double sigma_m);
  float operator()(double x_m, double y_m);

 private:
  struct Entry {
    std::int64_t x;
    std::int64_t y;
    double value;
  };
  double lattice(std::int64_t x, std::int64_t y);

  std::uint64_t seed_;
  double inverse_spacing_;
  std::int64_t cell_x_;
  std::int64_t cell_y_;
  std::array<double, 16> cell_{};  // the lattice values around the last position
  std::vector<Entry> memory_;
};

}  // namespace belvedere
