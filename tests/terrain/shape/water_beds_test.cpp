#include "terrain/shape/water_beds.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace belvedere {
namespace {

constexpr double bed_cell_m = 10.0;

struct Ground {
  Dem dem;
  Grid<std::uint8_t> water;
};

// A crater of 795 m radius filled to 500 m, whose banks rise by `slope`, and a river of 60 m width
// that leaves it to the east.
Ground crater(double slope) {
  Ground ground;
  ground.dem.altitude_m = Grid<float>(260, 240);
  ground.dem.filled = Grid<std::uint8_t>(260, 240, 0);
  ground.dem.transform = {0.0, 0.0, bed_cell_m, bed_cell_m};
  ground.water = Grid<std::uint8_t>(260, 240, 0);
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 260; ++x) {
      const double r = bed_cell_m * std::hypot(x - 110, y - 120);
      const bool river = x > 110 && std::abs(y - 120) <= 3;
      ground.water(x, y) = r <= 795.0 || river ? 1 : 0;
      ground.dem.altitude_m(x, y) =
          ground.water(x, y) != 0 ? 500.F : static_cast<float>(500.0 + slope * (r - 795.0));
    }
  return ground;
}

TEST(WaterBeds, GoOnAsTheBanksBegin) {
  for (const double slope : {0.1, 0.3}) {
    const Ground g = crater(slope);
    const WaterBeds beds = make_water_beds(g.water, g.dem);
    // Along a row to the west: the shore lies 5 m outside the last cell of water, and the bank at
    // it on average a little outside 800 m.
    for (int x = 31; x < 100; ++x) {
      const double off_m = bed_cell_m * (x - 30) - 5.0;
      const double expected = 60.0 * (1.0 - std::exp(-slope * off_m / 60.0));
      EXPECT_NEAR(beds.depth_m(x, 120), expected, 0.12 * expected + 0.2) << slope << " at " << x;
    }
    for (int x = 31; x < 100; ++x) EXPECT_GE(beds.depth_m(x + 1, 120), beds.depth_m(x, 120));
    EXPECT_EQ(beds.depth_m(20, 120), 0.F);
  }
}

TEST(WaterBeds, SteepBanksFallOffFasterThanFlatOnes) {
  const Ground steep = crater(0.4);
  const Ground flat = crater(0.02);
  EXPECT_GT(make_water_beds(steep.water, steep.dem).depth_m(35, 120),
            3.F * make_water_beds(flat.water, flat.dem).depth_m(35, 120));
}

TEST(WaterBeds, RiversAreNoLakes) {
  const Ground g = crater(0.2);
  const WaterBeds beds = make_water_beds(g.water, g.dem);
  EXPECT_EQ(beds.lake(110, 120), 1.F);
  EXPECT_EQ(beds.lake(32, 120), 1.F) << "up to its shore";
  EXPECT_EQ(beds.lake(110, 45), 1.F);
  EXPECT_EQ(beds.lake(240, 120), 0.F);
  EXPECT_EQ(beds.lake(10, 10), 0.F);
  // It becomes one over a river's width.
  EXPECT_GT(beds.lake(197, 120), 0.F);
  EXPECT_LT(beds.lake(205, 120), 1.F);
}

TEST(WaterBeds, LevelsStayAndWindowsAgree) {
  const Ground g = crater(0.2);
  const Grid<float> before = g.dem.altitude_m;
  const WaterBeds whole = make_water_beds(g.water, g.dem);
  EXPECT_TRUE(g.dem.altitude_m == before);
  // A window whose border is farther away than the reach of beds.
  Ground part;
  part.dem.altitude_m = Grid<float>(120, 200);
  part.dem.filled = Grid<std::uint8_t>(120, 200, 0);
  part.dem.transform = {0.0, 0.0, bed_cell_m, bed_cell_m};
  part.water = Grid<std::uint8_t>(120, 200, 0);
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 120; ++x) {
      part.dem.altitude_m(x, y) = g.dem.altitude_m(x, y + 20);
      part.water(x, y) = g.water(x, y + 20);
    }
  const WaterBeds window = make_water_beds(part.water, part.dem);
  for (int y = 70; y < 130; ++y)
    for (int x = 10; x < 60; ++x) {
      ASSERT_EQ(window.depth_m(x, y), whole.depth_m(x, y + 20));
      ASSERT_EQ(window.lake(x, y), whole.lake(x, y + 20));
    }
}

TEST(WaterBeds, OceansWithoutAShoreAreDeepAndSizesMustAgree) {
  Ground g = crater(0.2);
  g.water = Grid<std::uint8_t>(260, 240, 1);
  const WaterBeds beds = make_water_beds(g.water, g.dem);
  EXPECT_EQ(beds.depth_m(50, 50), 60.F);
  EXPECT_EQ(beds.lake(50, 50), 1.F);
  EXPECT_THROW(make_water_beds(Grid<std::uint8_t>(3, 3, 0), g.dem), Error);
}

}  // namespace
}  // namespace belvedere
