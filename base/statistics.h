#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace belvedere {

// The value at a rank in ascending order, from 0. There must be more values than that; they are
// reordered.
template <class T>
T value_at_rank(std::vector<T>& values, std::size_t rank) {
  const auto position = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), position, values.end());
  return *position;
}

// The median of one or more values; the upper of the two middle ones if their number is even.
template <class T>
T middle_value(std::vector<T> values) {
  return value_at_rank(values, values.size() / 2);
}

// The value with `share` (0…1) of the others below it, rounded down; of one or more values.
template <class T>
T value_at_share(std::vector<T> values, double share) {
  return value_at_rank(values,
                       static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

// The median; the mean of the two middle values if their number is even; 0 without values.
double median(std::vector<double> values);

// The value below which `share` (0…1) of the values lie, at the nearest rank; 0 without values.
double percentile(std::vector<double> values, double share);

}  // namespace belvedere
