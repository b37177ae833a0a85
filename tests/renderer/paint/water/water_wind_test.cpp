#include "renderer/paint/water/water_wind.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

// Share of ruffled water over 40 × 40 km.
double ruffled_share(std::uint64_t seed, float strength) {
  WaterWind wind(seed);
  double sum = 0.0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 200; ++x)
      sum += static_cast<double>(wind.ruffled({200.0 * x, 200.0 * y, 900.0}, 10.0F, strength));
  return sum / 40000.0;
}

TEST(WaterWind, RufflesPatchesOfALake) {
  EXPECT_EQ(ruffled_share(1, 0.0F), 0.0);
  EXPECT_NEAR(ruffled_share(1, 1.0F), 0.2, 0.05);
  EXPECT_GT(ruffled_share(1, 2.0F), ruffled_share(1, 1.0F) + 0.05);
}

TEST(WaterWind, HangsOnThePlaceAlone) {
  WaterWind a(5);
  WaterWind b(5);
  for (int k = 0; k < 50; ++k) b.ruffled({31.0 * k, 7.0 * k, 0.0}, 3.0F, 1.0F);
  EXPECT_EQ(a.ruffled({1234.5, -77.0, 900.0}, 8.0F, 1.0F),
            b.ruffled({1234.5, -77.0, 100.0}, 8.0F, 1.0F));
}

}  // namespace
}  // namespace belvedere
