#pragma once

#include <cstdint>
#include <glm/vec4.hpp>

#include "base/grid.h"

namespace belvedere {

// Cyan, magenta, yellow and black of a pixel, 0…1 each.
using Inks = glm::vec4;

// The ink coverage of a picture: the sum of the four inks, 0…400 %; too much of it does not dry.
struct InkCoverage {
  double limit_percent = 400.0;
  std::uint64_t pixels = 0;
  std::uint64_t pixels_above =
      0;  // above the limit by more than .5 %, half a step of 8 bits in two inks
  double highest_percent = 0.0;
  double mean_percent = 0.0;
  double above_share() const {
    return pixels == 0 ? 0.0 : static_cast<double>(pixels_above) / static_cast<double>(pixels);
  }
};

// Counts rows in any split.
class InkCount {
 public:
  explicit InkCount(double limit_percent) { coverage_.limit_percent = limit_percent; }
  void add(const Grid<Inks>& rows);
  InkCoverage coverage() const;

 private:
  InkCoverage coverage_;
  std::uint64_t sum_ =
      0;  // of coverages, in steps of 1/65536 %: whole numbers add up the same in any order
};

}  // namespace belvedere
