#include "terrain/cover/ground_lakes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tests/terrain/cover/class_rules_ground.h"

namespace belvedere {
namespace {

// Slopes around a round lake of 400 m at 500 m.
Dem hollow() {
  return test::ground(80, [](double e, double n) {
    return 500.0 + std::max(0.0, 0.2 * (std::hypot(e, n) - 400.0));
  });
}
std::size_t count(const Grid<std::uint8_t>& mask) {
  return static_cast<std::size_t>(std::count(mask.begin(), mask.end(), 1));
}

TEST(GroundLakes, LevelGroundWithBanksIsOne) {
  const Grid<std::uint8_t> lakes = ground_lakes(hollow(), {}, {});
  EXPECT_EQ(lakes(40, 40), 1);
  EXPECT_EQ(lakes(2, 40), 0);
  EXPECT_NEAR(static_cast<double>(count(lakes)), 3.14159 * 400.0 * 400.0 / 900.0, 60.0);
}

TEST(GroundLakes, NothingAtSeaIsOne) {
  Sea sea;
  sea.mask = Grid<std::uint8_t>(80, 80, 0);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 40; ++x) sea.mask(x, y) = 1;
  const Grid<std::uint8_t> lakes = ground_lakes(hollow(), {}, sea);
  EXPECT_EQ(lakes(38, 40), 0);
  EXPECT_EQ(lakes(42, 40), 1);
}

TEST(GroundLakes, HalvedCellsAskForFewerOfThem) {
  Dem dem = hollow();
  LakeParameters large;
  large.min_cells = 1200;  // the lake has some 560
  EXPECT_EQ(count(ground_lakes(dem, large, {})), 0U);
  dem.halved = 1;
  EXPECT_GT(count(ground_lakes(dem, large, {})), 400U);
}

// A void that extends beyond the window's edge is a lake if the surrounding ground has a lake
// there.
TEST(GroundLakes, HolesOverTheRimAreWhatTheWholeKnows) {
  Dem dem = test::ground(80, [](double e, double n) {
    return 500.0 + std::max(0.0, 0.2 * (std::hypot(e + 1200.0, n) - 400.0));
  });
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x)
      if (dem.altitude_m(x, y) < 500.5F) dem.filled(x, y) = 1;
  LakeParameters none_level;
  none_level.min_cells = 150;
  none_level.min_bank_m = 99.F;  // holes alone
  ASSERT_EQ(count(ground_lakes(dem, none_level, {})), 0U);
  EXPECT_GT(count(ground_lakes(dem, none_level, {}, Grid<std::uint8_t>(80, 80, 1))), 150U);
}

}  // namespace
}  // namespace belvedere
