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

TEST(Treeline, SunnySlopesAreHigher) {
  EXPECT_DOUBLE_EQ(radiation_warmth_k(1.0, SlopeWarmth{}.trees_k), 0.0);
  EXPECT_DOUBLE_EQ(radiation_warmth_k(1.25, 2.0), 0.5);
  EXPECT_DOUBLE_EQ(radiation_warmth_k(0.5, 2.0), -1.0);
}

TEST(Dryness, KnowsWoodsFromDeserts) {
  const auto at = [](double longitude, double latitude, double altitude_m) {
    const PlaceClimate place = default_climate(longitude, latitude);
    return dryness(monthly_c(place, altitude_m), rain_mm(place, altitude_m));
  };
  EXPECT_GT(at(8.6, 47.4, 600.0).forest, 0.9);      // Zürich
  EXPECT_GT(at(-60.0, -3.1, 70.0).forest, 0.9);     // Manaus
  EXPECT_GT(at(-122.3, 47.5, 100.0).forest, 0.9);   // Seattle
  EXPECT_GT(at(129.7, 62.0, 200.0).forest, 0.5);    // Yakutsk: larch woods on 235 mm
  EXPECT_LT(at(-104.9, 39.8, 1600.0).forest, 0.6);  // Denver
  EXPECT_LT(at(32.9, 40.0, 900.0).forest, 0.5);     // Ankara
  EXPECT_EQ(at(31.4, 30.1, 80.0).forest, 0.0);      // Cairo
  EXPECT_GT(at(31.4, 30.1, 80.0).desert, 0.9);
  EXPECT_EQ(at(8.6, 47.4, 600.0).desert, 0.0);
}

TEST(Dryness, IsHoldridgesRatio) {
  const Dryness dry = dryness(constant(10.0), 589.3);
  EXPECT_NEAR(dry.biotemperature_c, 10.0, 1e-12);
  EXPECT_NEAR(dry.thirst, 1.0, 1e-12);
  EXPECT_NEAR(dry.martonne, 589.3 / 20.0, 1e-9);
  EXPECT_EQ(dry.forest, 1.0);
}

TEST(Dryness, WoodsBeginAboveTheSteppe) {
  PlaceClimate place;
  place.sea_level_c = constant(22.0);
  place.lapse_k_per_km.fill(6.0);
  place.rain_mm_at_km.fill(500.0);
  const double lower = lower_treeline_m(place);
  // Half of the ground is wood where the ratio is 1.4.
  EXPECT_NEAR(58.93 * (22.0 - 0.006 * lower) / 500.0, 1.4, 1e-3);
  place.rain_mm_at_km.fill(3000.0);
  EXPECT_EQ(lower_treeline_m(place), -2000.0);
  place.rain_mm_at_km.fill(50.0);
  EXPECT_EQ(lower_treeline_m(place), 9000.0);
}

}  // namespace
}  // namespace belvedere
