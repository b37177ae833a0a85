#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/cache/bytes.h"
#include "base/grid.h"

namespace belvedere {

// A list of items of different length in the form that the cache stores: a row of integers and a
// row of other numbers, in the order of the items.
struct PackedRows {
  Grid<std::int32_t> counts;
  Grid<double> numbers;
};

void each_field(auto& bytes, FieldsOf<PackedRows> auto& packed) {
  auto& [counts, numbers] = packed;
  bytes(counts, numbers);
}

// Numbers as a grid of one row.
template <class T>
Grid<T> row_of(const std::vector<T>& values) {
  if (values.empty()) return {};
  Grid<T> grid(static_cast<int>(values.size()), 1);
  std::copy(values.begin(), values.end(), grid.begin());
  return grid;
}

}  // namespace belvedere
