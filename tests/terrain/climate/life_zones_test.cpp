#include "terrain/climate/life_zones.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace belvedere {
namespace {

Months constant(double celsius) {
  Months months{};
  months.fill(celsius);
  return months;
}

// Months of a mean and a cosine with its top in July.
Months seasons(double mean, double swing) {
  Months months{};
  for (std::size_t m = 0; m < 12; ++m) months[m] = mean - swing * std::cos(2.0 * std::numbers::pi * static_cast<double>(m) / 12.0);
  return months;
}

TEST(Treeline, IsWhereTheExcessIsNone) {
  PlaceClimate place;
  place.sea_level_c = seasons(11.0, 10.0);
  place.lapse_k_per_km.fill(5.5);
  const double line = treeline_m(place);
  EXPECT_NEAR(treeline_excess_k(monthly_c(place, line)), 0.0, 1e-4);
  // A kelvin is worth 1000 / 5.5 m.
  EXPECT_NEAR(treeline_m(place, 1.0) - line, 1000.0 / 5.5, 0.05);
  // Without seasons: 6.4 °C.
  place.sea_level_c = constant(28.4);
  EXPECT_NEAR(treeline_m(place), 4000.0, 0.05);
}

}  // namespace
}  // namespace belvedere
