#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/random.h"
#include "terrain/layers/fit/fit_cells.h"

namespace belvedere::synthetic {

// The probability of the upper class at a sample of either input.
inline double rising(std::uint8_t sample) {
  return 1.0 / (1.0 + std::exp(-(static_cast<double>(sample) - 128.0) / 16.0));
}
inline double falling(std::uint8_t sample) {
  return 1.0 / (1.0 + std::exp((static_cast<double>(sample) - 180.0) / 20.0));
}

// Two classes of which class 1 covers rising(input 0) · falling(input 1); a third input has no
// information.
inline FitCells two_classes(std::size_t count, std::uint64_t seed = 7) {
  FitCells cells{2, std::vector<std::vector<std::uint8_t>>(3, std::vector<std::uint8_t>(count)),
                 std::vector<std::uint8_t>(count)};
  for (std::size_t i = 0; i != count; ++i) {
    const auto at = static_cast<std::int64_t>(i);
    for (std::size_t a = 0; a != 3; ++a)
      cells.inputs[a][i] =
          static_cast<std::uint8_t>(random_index(256, seed, at, static_cast<std::int64_t>(a)));
    cells.labels[i] =
        random_uniform(seed, at, 5) < rising(cells.inputs[0][i]) * falling(cells.inputs[1][i]) ? 1
                                                                                               : 0;
  }
  return cells;
}

}  // namespace belvedere::synthetic
