#pragma once

#include <cmath>
#include <numbers>

#include "terrain/climate/zonal_climate.h"

namespace belvedere::test {

inline Months constant(double celsius) {
  Months months{};
  months.fill(celsius);
  return months;
}

// Months of a mean and a cosine with its top in July.
inline Months seasons(double mean, double swing) {
  Months months{};
  for (std::size_t m = 0; m < 12; ++m)
    months[m] = mean - swing * std::cos(2.0 * std::numbers::pi * static_cast<double>(m) / 12.0);
  return months;
}

}  // namespace belvedere::test
