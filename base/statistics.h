#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace belvedere {

// The value at a rank in the order of size, from 0. The values, of which there are more than that, change their order.
template <class T>
T value_at_rank(std::vector<T>& values, std::size_t rank) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

// The middle one of one value or more; the upper of the two where their number is even.
template <class T>
T middle_value(std::vector<T> values) {
  return value_at_rank(values, values.size() / 2);
}

// The value with `share` (0…1) of the others below it, rounded down; of one value or more.
template <class T>
T value_at_share(std::vector<T> values, double share) {
  return value_at_rank(values, static_cast<std::size_t>(share * static_cast<double>(values.size() - 1)));
}

// The median; the mean of the two middle values where their number is even; 0 without values.
double median(std::vector<double> values);

// The value below which `share` (0…1) of the values lie, at the nearest rank; 0 without values.
double percentile(std::vector<double> values, double share);

}  // namespace belvedere
