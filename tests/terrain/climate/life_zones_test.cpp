#include "terrain/climate/life_zones.h"

#include <gtest/gtest.h>

#include "tests/terrain/climate/made_up_months.h"

namespace belvedere {
namespace {

using test::constant;
using test::seasons;

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
