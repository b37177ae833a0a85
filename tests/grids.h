#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/grid.h"

// Grids, as tests of all layers make and compare them.
namespace belvedere::test {

// A function of column and row.
template <class F>
Grid<float> grid_of(int width, int height, F&& f) {
  Grid<float> grid(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) grid(x, y) = static_cast<float>(f(x, y));
  return grid;
}

inline double largest_difference(const Grid<float>& a, const Grid<float>& b) {
  EXPECT_TRUE(a.same_size(b));
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, std::abs(static_cast<double>(a[i]) - b[i]));
  return largest;
}

}  // namespace belvedere::test
