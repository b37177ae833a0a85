#include "terrain/shape/catchments.h"

#include <gtest/gtest.h>

#include <cmath>

#include "terrain/shape/hydrology.h"

namespace belvedere {
namespace {

TEST(Catchments, AreThoseOfTheDemWhoeverAsksAndHoweverOften) {
  Dem dem;
  dem.altitude_m = Grid<float>(50, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 50; ++x)
      dem.altitude_m(x, y) =
          500.F - 3.F * static_cast<float>(y) + std::abs(static_cast<float>(x) - 20.F);
  dem.transform = {0.0, 0.0, 100.0, 100.0};
  dem.entries = {{20, 0, 77.0}};
  const Grid<float> expected = flow_accumulation_km2(dem.altitude_m, 100.0, dem.entries);
  Catchments catchments(dem);
  EXPECT_EQ(catchments.km2(), expected);
  EXPECT_GT(catchments.km2()(20, 39), 77.F) << "rivers from beyond count";
  EXPECT_EQ(&catchments.km2(), &catchments.km2()) << "found once";
  EXPECT_EQ(catchments.take_km2(), expected);
  EXPECT_EQ(catchments.km2(), expected) << "computed again after they were taken";
}

}  // namespace
}  // namespace belvedere
