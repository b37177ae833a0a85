#pragma once

#include <algorithm>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// Numbers as a grid of one row: how the cache keeps lists.
template <class T>
Grid<T> row_of(const std::vector<T>& values) {
  if (values.empty()) return {};
  Grid<T> grid(static_cast<int>(values.size()), 1);
  std::copy(values.begin(), values.end(), grid.begin());
  return grid;
}

}  // namespace belvedere
