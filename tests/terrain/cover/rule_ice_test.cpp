#include "terrain/cover/class_rules.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/grids.h"

namespace belvedere::class_rules {
namespace {

// A valley of 18 km that falls to the south from a snow field; every `step`-th cell of 30 m, from
// row y0 on.
constexpr int columns = 120;
constexpr int rows = 600;
Dem valley(int step, int y0, int y1) {
  Dem dem;
  dem.transform = {-15.0 * (step - 1), 15.0 * (step - 1) - 30.0 * y0, 30.0 * step, 30.0 * step};
  dem.altitude_m = Grid<float>(columns / step, (y1 - y0) / step);
  dem.filled = Grid<std::uint8_t>(dem.width(), dem.height(), 0);
  for (const auto [x, y] : test::cells(dem))
    dem.altitude_m(x, y) = static_cast<float>(3200.0 - 0.08 * 30.0 * (y0 + y * step) +
                                              0.25 * 30.0 * std::abs(x * step - columns / 2));
  return dem;
}
// Snow on the uppermost 150 rows, and below it a little more melts than falls.
Grid<float> balance(int step, int y0, int y1) {
  return test::grid_of(columns / step, (y1 - y0) / step,
                       [&](int, int y) { return y0 + y * step < 150 ? 1.F : -1.5F; });
}

TEST(FlowingIce, GoesOnIntoAWindowBelowItsSnow) {
  const RuleIce whole = flowing_ice(balance(1, 0, rows), valley(1, 0, rows));
  const RuleIce coarse = flowing_ice(balance(2, 0, rows), valley(2, 0, rows));
  const RuleGround around{valley(2, 0, rows).transform, {}, coarse.km2, coarse.surface_m};
  constexpr int y0 = 220;
  const Dem window = valley(1, y0, rows);
  const std::vector<IceEntry> entries = find_ice_entries(around, window);
  double entering = 0.0;
  for (const IceEntry& entry : entries) entering += static_cast<double>(entry.km2);
  double through = 0.0;  // the row above the window, where nothing flows level
  for (int x = 0; x < columns; ++x) through += static_cast<double>(whole.km2(x, y0 - 1));
  ASSERT_GT(through, 5.0);
  EXPECT_NEAR(entering / through, 1.0, 0.15);

  const RuleIce alone = flowing_ice(balance(1, y0, rows), window);
  const RuleIce joined = flowing_ice(balance(1, y0, rows), window, entries);
  int of_whole = 0, of_joined = 0, both = 0;
  for (const auto [x, y] : test::cells(columns, window.height())) {
    EXPECT_EQ(alone.covered(x, y), 0.F);
    const bool is = whole.covered(x, y0 + y) > 0.5F;
    const bool joins = joined.covered(x, y) > 0.5F;
    of_whole += is ? 1 : 0;
    of_joined += joins ? 1 : 0;
    both += is && joins ? 1 : 0;
  }
  EXPECT_GT(of_whole, 2000);
  EXPECT_GT(both, 0.85 * (of_whole + of_joined - both))
      << of_whole << " cells of the whole, " << of_joined << " of the window";
}

TEST(FlowingIce, NothingEntersWhereNothingIsKnownOrTheWholeEnds) {
  const Dem window = valley(1, 0, rows);
  EXPECT_TRUE(find_ice_entries({}, window).empty());
  const RuleIce coarse = flowing_ice(balance(2, 0, rows), valley(2, 0, rows));
  EXPECT_TRUE(
      find_ice_entries({valley(2, 0, rows).transform, {}, coarse.km2, coarse.surface_m}, window)
          .empty());
}

}  // namespace
}  // namespace belvedere::class_rules
