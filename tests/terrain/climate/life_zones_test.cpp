#include "terrain/climate/life_zones.h"

#include <gtest/gtest.h>

#include "tests/terrain/climate/synthetic_months.h"

namespace belvedere {
namespace {

using test::constant;
using test::seasons;

TEST(Treeline, IsWhereTheExcessIsNone) {
  PlaceClimate position;
  position.sea_level_c = seasons(11.0, 10.0);
  position.lapse_k_per_km.fill(5.5);
  const double line = treeline_m(position);
  EXPECT_NEAR(treeline_excess_k(monthly_c(position, line)), 0.0, 1e-4);
  // A kelvin is worth 1000 / 5.5 m.
  EXPECT_NEAR(treeline_m(position, 1.0) - line, 1000.0 / 5.5, 0.05);
  // Without seasons: 6.4 °C.
  position.sea_level_c = constant(28.4);
  EXPECT_NEAR(treeline_m(position), 4000.0, 0.05);
}

}  // namespace
}  // namespace belvedere
