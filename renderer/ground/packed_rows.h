#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/cache/bytes.h"
#include "base/grid.h"

namespace belvedere {

// A list of things of different length as the cache keeps it: whole numbers and others, each in a row, in the order of the things.
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
