#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "base/grid.h"

namespace belvedere {

// Interpolates a grid with voids (NaN); positions in cells, centres at whole numbers. Private to
// terrain/.
// Keys' cubic convolution (1981, a = -1/2) keeps summits that bilinear means would lower. It is
// stretched if the source is finer than the target, so that it averages. Its result is limited to
// the range of the cells it reads: a lake next to a slope stays flat instead of rippling. Near a
// void, the result is the mean of the known cells under a tent as wide as the sampling distance, or
// void if they have less than half of its weight.
class Resampler {
 public:
  // Source cells per sample along columns and rows; below 1 counts as 1.
  explicit Resampler(glm::dvec2 source_cells_per_sample);

  // Radius in cells that a sample may read.
  glm::ivec2 reach() const;
  float sample(const Grid<float>& cells, glm::dvec2 at) const;

 private:
  float sample_tent(const Grid<float>& cells, glm::dvec2 at) const;

  glm::dvec2 scale_;
};

// The cell that contains the position; -1 outside.
std::int32_t sample_nearest(const Grid<std::int32_t>& cells, glm::dvec2 at);

}  // namespace belvedere
