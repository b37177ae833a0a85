#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "base/grid.h"
#include "base/pixel_rect.h"

// Grids, as tests of all layers walk through, make and compare them.
namespace belvedere::test {

// The cells of a rectangle, row by row, or every step-th of each way.
class Cells {
 public:
  struct Cell {
    int x;
    int y;
  };
  Cells(PixelRect rect, int step) : rect_(rect), step_(step) {}

  class Iterator {
   public:
    Iterator(PixelRect rect, int step) : rect_(rect), step_(step), at_{rect.x0, rect.y0} {}
    Cell operator*() const { return at_; }
    Iterator& operator++() {
      at_.x += step_;
      if (at_.x >= rect_.x1) at_ = {rect_.x0, at_.y + step_};
      return *this;
    }
    bool operator==(std::default_sentinel_t) const {
      return at_.x >= rect_.x1 || at_.y >= rect_.y1;
    }

   private:
    PixelRect rect_;
    int step_;
    Cell at_;
  };
  Iterator begin() const { return {rect_, step_}; }
  static std::default_sentinel_t end() { return {}; }

 private:
  PixelRect rect_;
  int step_;
};

// for (const auto [x, y] : test::cells(40, 20)) …
// Clang before 16 refuses lambdas that read such an x or y: they need two loops around them.
inline Cells cells(int width, int height) { return {{0, 0, width, height}, 1}; }
inline Cells cells(PixelRect rect, int step = 1) { return {rect, step}; }
// All of a grid, or of what is as wide and high as one.
template <class G>
Cells cells(const G& grid) {
  return {{0, 0, grid.width(), grid.height()}, 1};
}

// A function of column and row.
template <class T = float, class F>
Grid<T> grid_of(int width, int height, F&& f) {
  Grid<T> grid(width, height);
  for (const auto [x, y] : cells(grid)) grid(x, y) = static_cast<T>(f(x, y));
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
