#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "base/grid.h"

namespace belvedere {

// Values of a grid with voids (NaN) between its cells; places in cells, centres at whole numbers. Private to terrain/.
//
// Keys' cubic convolution (1981, a = -1/2) keeps summits that bilinear means would lower, and is stretched where the source
// is finer than what is asked for, so that it averages. Its result never leaves the range of the cells it saw: a lake
// beside a slope stays flat instead of rippling. Where a cell is void, the mean of the known cells under a tent as wide
// as the sampling distance, or void where they have less than half of its weight.
class Resampler {
 public:
  // Source cells per sample along columns and rows; below 1 counts as 1.
  explicit Resampler(glm::dvec2 source_cells_per_sample);

  // Cells to either side that a sample may look at.
  glm::ivec2 reach() const;
  float sample(const Grid<float>& cells, glm::dvec2 at) const;

 private:
  float sample_tent(const Grid<float>& cells, glm::dvec2 at) const;

  glm::dvec2 scale_;
};

// The cell that holds the place; -1 outside.
std::int32_t sample_nearest(const Grid<std::int32_t>& cells, glm::dvec2 at);

}  // namespace belvedere
