#include "terrain/cover/rule_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "base/grid.h"
#include "terrain/cover/class_rules.h"
#include "terrain/cover/class_rules_inputs.h"
#include "tests/grids.h"
#include "tests/terrain/cover/class_rules_ground.h"

namespace belvedere {
namespace {

constexpr GeoTransform fine{10000.0, 20000.0, 30.0, 30.0};
// Every second cell of it.
constexpr GeoTransform coarse{10000.0 - 15.0, 20000.0 + 15.0, 60.0, 60.0};

const RuleGround nothing;
const RuleAround around{nothing, {20, 30, 180, 170}, 32};

TEST(OwnShare, GrowsFromTheEdgeOfThePartAlongARaggedLine) {
  const Grid<float> share = own_share(around, fine, 200, 200, 7);
  float min = 1.F;
  float max = 0.F;
  for (const auto [x, y] : test::cells(200, 200)) {
    const int from_edge = std::min({x - 20, 179 - x, y - 30, 169 - y});
    if (from_edge <= 0) {
      EXPECT_EQ(share(x, y), 0.F) << x << ' ' << y;
    }
    if (from_edge >= 32) {
      EXPECT_EQ(share(x, y), 1.F) << x << ' ' << y;
    }
  }
  // Position of a straight line at half the distance.
  for (int y = 70; y < 130; ++y)
    min = std::min(min, share(36, y)), max = std::max(max, share(36, y));
  EXPECT_LT(min, 0.25F);
  EXPECT_GT(max, 0.75F);
}

TEST(OwnShare, HangsOnPlacesAndSeed) {
  const Grid<float> share = own_share(around, fine, 200, 200, 7);
  // The same part in a window that begins elsewhere.
  const GeoTransform moved{fine.origin_x - 5 * 30.0, fine.origin_y + 4 * 30.0, 30.0, 30.0};
  const Grid<float> other = own_share({nothing, {25, 34, 185, 174}, 32}, moved, 205, 204, 7);
  for (const auto [x, y] : test::cells(200, 200))
    EXPECT_NEAR(share(x, y), other(x + 5, y + 4), 1e-5F);
  EXPECT_NE(share, own_share(around, fine, 200, 200, 8));
}

TEST(JoinInput, IsThatOfTheGroundAroundAtTheEdgeAndItsOwnInside) {
  const Grid<float> there = test::grid_of(110, 110, [&](int x, int y) { return 2 * x - 3 * y; });
  const Grid<float> share = own_share(around, fine, 200, 200, 7);
  Grid<float> own(200, 200, 1000.F);
  join_input(own, there, share, fine, coarse);
  for (const auto [x, y] : test::cells(200, 200)) {
    const float expected = static_cast<float>(x) - 1.5F * static_cast<float>(y);
    const int from_edge = std::min({x - 20, 179 - x, y - 30, 169 - y});
    if (from_edge <= 0) {
      EXPECT_NEAR(own(x, y), expected, 1e-3F) << x << ' ' << y;
    }
    if (from_edge >= 32) {
      EXPECT_EQ(own(x, y), 1000.F);
    }
    EXPECT_GE(own(x, y), expected - 1e-3F);
    EXPECT_LE(own(x, y), 1000.F);
  }
  Grid<float> none;
  join_input(none, there, share, fine, coarse);
  EXPECT_TRUE(none.empty());
}

TEST(RuleGround, PartsKeepTheirPlace) {
  RuleGround ground{fine, {Grid<float>(), Grid<float>(50, 40)}, Grid<float>(50, 40), Grid<float>()};
  ground.inputs[1](12, 9) = 3.F;
  ground.ice_km2(12, 9) = 4.F;
  const RuleGround part = part_of(std::move(ground), {10, 5, 30, 25});
  EXPECT_TRUE(part.inputs[0].empty());
  EXPECT_EQ(part.inputs[1].width(), 20);
  EXPECT_EQ(part.inputs[1](2, 4), 3.F);
  EXPECT_EQ(part.ice_km2(2, 4), 4.F);
  EXPECT_EQ(part.transform.to_crs(2, 4), fine.to_crs(12, 9));
}

// relief_4000 of a window equals that of the whole, far from the window's edge as well.
TEST(RuleGround, WideReliefOfAWindowReachesOverTheWhole) {
  const auto altitude = [](double e, double n) {
    return 1500.0 + 0.05 * e + 500.0 * std::sin(e / 2500.0) * std::cos(n / 3000.0);
  };
  const Dem whole = test::ground(1300, altitude);
  const PixelRect cells{580, 600, 720, 730};
  Dem window = whole;
  window.altitude_m = part_of(whole.altitude_m, cells);
  window.filled = part_of(whole.filled, cells);
  window.transform.origin_x += cells.x0 * whole.transform.cell_x;
  window.transform.origin_y -= cells.y0 * whole.transform.cell_y;
  const ClassRules rules{
      "one", {{"speck_cells", 0.0}}, {}, {{LandCoverClass::rock, "relief_4000 > 0"}}};
  const std::vector<std::string>& names = class_rules::variable_names();
  const auto slot = static_cast<std::size_t>(std::find(names.begin(), names.end(), "relief_4000") -
                                             names.begin());
  const Grid<float> of_whole = part_of(see_rule_ground(rules, {}, whole).inputs[slot], cells);
  ClassRuleParameters parameters;
  const Grid<float> alone = see_rule_ground(rules, parameters, window).inputs[slot];
  parameters.whole = &whole;
  const Grid<float> joined = see_rule_ground(rules, parameters, window).inputs[slot];
  float apart = 0.F;
  float apart_alone = 0.F;
  // At the window's edge, in its halo, the spline between blocks of a kilometre ends.
  for (const auto [x, y] : test::cells({48, 48, 92, 82})) {
    apart = std::max(apart, std::abs(joined(x, y) - of_whole(x, y)));
    apart_alone = std::max(apart_alone, std::abs(alone(x, y) - of_whole(x, y)));
  }
  EXPECT_LT(apart, 2.F);
  EXPECT_GT(apart_alone, 5.F * apart) << "the window alone knows less than 4 km around";
}

}  // namespace
}  // namespace belvedere
