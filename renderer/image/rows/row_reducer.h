#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "base/image.h"

namespace belvedere {

// Reduces a picture by a whole factor while its rows arrive: each pixel is the mean of factor ×
// factor, at the right and lower border of the available ones. Sums are in double, row by row, so
// that the split into rows changes no bit.
class RowReducer {
 public:
  // factor ≥ 1
  RowReducer(int width, int height, int factor);
  // The reduced rows that are complete with these: often none, which is an empty picture.
  Image reduce(const Image& rows);

  int width() const { return (width_ + factor_ - 1) / factor_; }
  int height() const { return (height_ + factor_ - 1) / factor_; }

 private:
  int width_;
  int height_;
  int factor_;
  int next_row_ = 0;
  std::vector<glm::dvec3> sums_;  // of the current row
};

}  // namespace belvedere
