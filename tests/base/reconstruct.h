#pragma once

#include <utility>
#include <vector>

#include "base/pyramid.h"

namespace belvedere::test {

// Equation 1 of Jenny, Jenny & Hurni (2011): the sum of the base and all bands; identical to the
// input up to float rounding.
inline Grid<float> reconstruct(const LaplacianPyramid& pyramid) {
  Grid<float> sum = pyramid.base;
  for (auto band = pyramid.bands.rbegin(); band != pyramid.bands.rend(); ++band) {
    Grid<float> finer = *band;
    std::vector<float> coarse(static_cast<std::size_t>(finer.width()));
    for (int y = 0; y < finer.height(); ++y) {
      expand_row(sum, y, finer.width(), coarse.data());
      for (int x = 0; x < finer.width(); ++x) finer(x, y) += coarse[static_cast<std::size_t>(x)];
    }
    sum = std::move(finer);
  }
  return sum;
}

}  // namespace belvedere::test
