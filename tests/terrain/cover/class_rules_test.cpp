#include "terrain/cover/class_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/parallel.h"
#include "terrain/cover/class_rules_inputs.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/terrain/cover/class_rules_ground.h"

namespace belvedere {
namespace {

using enum LandCoverClass;
using test::cone;
using test::ground;
using test::share;

Grid<LandCoverClass> apply(const ClassRules& rules, const Dem& dem,
                           const std::vector<std::pair<std::string, double>>& settings = {},
                           const std::vector<KnownTown>& towns = {}) {
  ClassRuleParameters parameters;
  parameters.settings = settings;
  parameters.towns = towns;
  parameters.seed = 7;
  return apply_class_rules(rules, parameters, dem, silent_progress()).classes.cells;
}

TEST(ClassRules, LifeZonesAreReadAndNameTheirParameters) {
  const ClassRules rules = read_class_rules("life_zones");
  EXPECT_EQ(rules.name, "life_zones");
  EXPECT_THAT(rules.parameters, testing::Contains(testing::Pair("treeline_m", 0.0)));
  EXPECT_GT(rules.layers.size(), 12U);
}

TEST(ClassRules, LaterLayersWinAndSeeTheClassSoFar) {
  ClassRules rules{"toy",
                   {},
                   {},
                   {{forest, "1"},
                    {rock, "easting > 2000"},
                    {scree, "is_rock and northing > 3000"},
                    {snow, "is_rock"}}};
  rules.parameters = {{"speck_cells", 0.0}};
  const Dem dem = ground(100, [](double, double) { return 100.0; });
  const Grid<LandCoverClass> c = apply(rules, dem);
  // East of 2000 m begins column 33; north of 3000 m ends row 66.
  EXPECT_EQ(c(10, 50), forest);
  EXPECT_EQ(c(32, 50), forest);
  EXPECT_EQ(c(33, 50), scree);
  EXPECT_EQ(c(33, 66), scree);
  EXPECT_EQ(c(33, 67), snow);
}

TEST(ClassRules, TerrainVariablesMeanWhatTheySay) {
  const auto at_centre = [](const std::string& when,
                            const std::function<double(double, double)>& f) {
    const ClassRules rules{"toy", {{"speck_cells", 0.0}}, {}, {{forest, "1"}, {rock, when}}};
    return apply(rules, ground(160, f))(80, 80) == rock;
  };
  const auto south_slope = [](double, double n) { return 1000.0 + 0.5 * n; };  // rises to the north
  EXPECT_TRUE(at_centre("south > 0.95", south_slope));
  EXPECT_FALSE(at_centre("south > -0.95", [](double, double n) { return 1000.0 - 0.5 * n; }));
  EXPECT_TRUE(at_centre("abs(south) < 0.01", [](double e, double) { return 1000.0 + 0.5 * e; }));
  EXPECT_TRUE(
      at_centre("north < -0.95 and abs(east) < 0.01 and abs(north + south) < 0.001", south_slope));
  EXPECT_TRUE(
      at_centre("relief_4000 > 250 and roughness > 0 and flatness > 1 and above_valley > 300",
                [](double e, double) { return 1000.0 - 0.5 * std::abs(e); }));
  EXPECT_TRUE(at_centre("abs(slope - 26.565) < 0.01", south_slope));
  EXPECT_TRUE(at_centre("abs(altitude - 1000) < 0.01", south_slope));
  const auto ridge = [](double e, double) { return 1000.0 - 0.5 * std::abs(e); };
  EXPECT_TRUE(at_centre("relief_180 > 20 and relief_750 > 100 and relief_1800 > 200", ridge));
  EXPECT_TRUE(at_centre("relief_180 < -20 and relief_750 < -100",
                        [](double e, double) { return 1000.0 + 0.5 * std::abs(e); }));
  EXPECT_TRUE(at_centre("abs(valley_height - 465) < 40",
                        ridge));  // 0.5 · 900 m, the window square; the valley is smoothed
  EXPECT_TRUE(at_centre("valley_floor > 0.99", [](double, double) { return 600.0; }));
  EXPECT_FALSE(at_centre("valley_floor > 0.01", [](double, double) { return 1600.0; }));
  EXPECT_TRUE(at_centre("lake > 0.5 and not river > 0.5", [](double e, double n) {
    return std::max(500.0, 300.0 + 0.2 * std::hypot(e, n));
  }));
}

TEST(ClassRules, ScreeBelowRockOnly) {
  // A wall between two gentle slopes, falling to the south.
  const Dem dem = ground(120, [](double, double n) {
    return n > 300.0 ? 2000.0 + 0.4 * (n - 300.0)
                     : (n > 0.0 ? 1500.0 + n * 5.0 / 3.0 : 1500.0 + 0.4 * n);
  });
  const ClassRules rules{
      "toy",
      {{"apron_m", 400.0}, {"speck_cells", 0.0}},
      {},
      {{forest, "1"}, {rock, "slope > 45"}, {scree, "is_forest and below_rock > 0.5"}}};
  const Grid<LandCoverClass> c = apply(rules, dem);
  int below = 0;
  int above = 0;
  for (int y = 0; y < 120; ++y) {
    if (c(60, y) != scree) continue;
    (30 * (60 - y) < 150 ? below : above) += 1;
  }
  EXPECT_GE(below, 5);  // half of 400 m are 6.7 cells
  EXPECT_LE(below, 8);
  EXPECT_EQ(above, 0);
}

TEST(ClassRules, ForestEndsAtARaggedTreeline) {
  const ClassRules rules = read_class_rules("life_zones");
  const Grid<LandCoverClass> c = apply(rules, cone());
  double lowest_grass = 1e9;
  double highest_forest = -1e9;
  for (std::size_t i = 0; i < c.size(); ++i) {
    const double z = static_cast<double>(cone().altitude_m[i]);
    if (c[i] == forest) highest_forest = std::max(highest_forest, z);
    if (c[i] == alpine_grass) lowest_grass = std::min(lowest_grass, z);
  }
  EXPECT_GT(highest_forest, 1820.0);
  EXPECT_LT(highest_forest, 2350.0);
  EXPECT_LT(lowest_grass, 1820.0);
  // The setting moves it.
  EXPECT_LT(share(apply(rules, cone(), {{"treeline_m", 1500.0}}), forest), share(c, forest) - 0.1);
  // Without raggedness the line on the west side is where the formula says: no exposure, and 35 m ·
  // relief / 60 m for the cone's convexity, whose relief_750 is 750² / 2 · 0.4663 / 2250 m = 58 m;
  // less 60 m for wind, because its relief_1800 is over 240 m.
  const Grid<LandCoverClass> smooth = apply(rules, cone(), {{"raggedness", 0.0}});
  int x = 0;
  while (smooth(x, 120) == forest || smooth(x, 120) == pasture || smooth(x, 120) == shrub) ++x;
  EXPECT_NEAR(cone().altitude_m(x, 120), 1794.F, 17.F);  // a cell is 14 m high
}

TEST(ClassRules, SnowReachesLowerOnTheNorthSide) {
  const Dem high =
      ground(240, [](double e, double n) { return 3500.0 - 0.4663 * std::hypot(e, n); });
  const Grid<LandCoverClass> c =
      apply(read_class_rules("life_zones"), high, {{"ice_line_m", 9000.0}});
  const auto lowest_snow = [&](bool north_side) {
    double lowest = 1e9;
    for (const auto [x, y] : test::cells(240, 240))
      if (c(x, y) == snow && (y < 120) == north_side && 2 * std::abs(x - 120) < std::abs(y - 120))
        lowest = std::min(lowest, static_cast<double>(high.altitude_m(x, y)));
    return lowest;
  };
  EXPECT_LT(lowest_snow(false), 3400.0);  // there is some
  EXPECT_LT(lowest_snow(true) + 200.0, lowest_snow(false));
}

TEST(ClassRules, WaterLiesOverAll) {
  const Dem dem = ground(
      160, [](double e, double n) { return std::max(600.0, 560.0 + 0.1 * std::hypot(e, n)); });
  for (const double winter : {0.0, 1.0}) {
    const Grid<LandCoverClass> c = apply(read_class_rules("life_zones"), dem, {{"winter", winter}});
    EXPECT_EQ(c(80, 80), water);
    EXPECT_NEAR(share(c, water), 3.14159 * 400.0 * 400.0 / (4800.0 * 4800.0), 0.006);
  }
}

// A coast that runs north: sea in the west, under noise of 2 m, a plain of 1 %, hills.
const Dem& shore_of_the_sea() {
  static const Dem dem = ground(300, [](double e, double n) {
    const double wave = 2.0 * std::sin(0.7 * e + 1.3 * n) * std::sin(2.9 * e - 0.8 * n);
    if (e < -1000.0) return wave;
    return e < 2000.0 ? 1.0 + 0.01 * (e + 1000.0) : 31.0 + 0.2 * (e - 2000.0);
  });
  return dem;
}

TEST(ClassRules, TheSeaIsWaterWithABeach) {
  ClassRules rules = read_class_rules("life_zones");
  const Dem& dem = shore_of_the_sea();
  // A town at the shore, half of it at sea.
  const Grid<LandCoverClass> c =
      apply(rules, dem, {}, {{.position = dem.transform.to_crs(118.0, 150.0), .radius_m = 600.0}});
  double water_at_sea = 0.0;
  double water_on_land = 0.0;
  double sand_by_the_sea = 0.0;
  for (const auto [x, y] : test::cells(300, 300)) {
    const double e = 30.0 * (x - 150);
    if (e < -1000.0) water_at_sea += c(x, y) == water ? 1.0 : 0.0;
    if (e > -900.0) water_on_land += c(x, y) == water ? 1.0 : 0.0;
    if (e > -1000.0 && e < -850.0) sand_by_the_sea += c(x, y) == sand ? 1.0 : 0.0;
    if (e > -300.0) {
      EXPECT_NE(c(x, y), sand);
    }
  }
  EXPECT_GT(water_at_sea / (300.0 * 117.0), 0.995);
  EXPECT_LT(water_on_land, 30.0);
  EXPECT_GT(sand_by_the_sea / (300.0 * 5.0), 0.4);
  EXPECT_EQ(c(100, 150), water);  // no houses in it
  EXPECT_GT(share(c, settlement), 0.0);
  // Without a sea, fields and houses are there, as on any plain.
  ClassRuleParameters without_sea;
  without_sea.sea.look = false;
  without_sea.seed = 7;
  const Grid<LandCoverClass> dry =
      apply_class_rules(rules, without_sea, dem, silent_progress()).classes.cells;
  EXPECT_LT(share(dry, water), 0.02);
  EXPECT_EQ(share(dry, sand), 0.0);
}

TEST(ClassRules, VariablesOfTheSea) {
  ClassRules rules{"toy",
                   {{"speck_cells", 0.0}},
                   {},
                   {{forest, "1"}, {sand, "coast > 0 and coast < 100"}, {water, "sea"}}};
  const Grid<LandCoverClass> c = apply(rules, shore_of_the_sea());
  EXPECT_EQ(c(20, 20), water);
  EXPECT_EQ(c(120, 20), sand);  // noise moves the shore by up to two cells
  EXPECT_EQ(c(126, 20), forest);
  // Far from any sea.
  EXPECT_EQ(share(apply(rules, cone()), forest), 1.0);
}

TEST(ClassRules, TheRiversideFollowsStreamsOfTwentySquareKilometres) {
  // A valley 9 km wide that falls to the south.
  const Dem dem = ground(300, [](double e, double n) { return 0.1 * std::abs(e) + 0.02 * n; });
  const ClassRules rules{
      "toy", {{"speck_cells", 0.0}}, {}, {{scree, "1"}, {pasture, "riverside < 200"}}};
  const Grid<LandCoverClass> c = apply(rules, dem);
  EXPECT_EQ(c(150, 290), pasture);
  EXPECT_EQ(c(155, 290), pasture);
  EXPECT_EQ(c(160, 290), scree);  // 300 m from it
  EXPECT_EQ(c(150, 20), scree);   // a catchment of 5 km²
}

TEST(ClassRules, ReedsGrowIntoLakesFromTheShore) {
  const Dem dem = ground(
      160, [](double e, double n) { return std::max(600.0, 560.0 + 0.05 * std::hypot(e, n)); });
  const ClassRules rules = read_class_rules("life_zones");
  const Grid<LandCoverClass> open = apply(rules, dem);
  const Grid<LandCoverClass> grown = apply(rules, dem, {{"reeds", 1.0}});
  EXPECT_LT(share(grown, water), 0.95 * share(open, water));
  EXPECT_GT(share(grown, water), 0.5 * share(open, water));
  // No reeds farther out than 400 m, and no water where the lake was not.
  for (const auto [x, y] : test::cells(160, 160)) {
    if (grown(x, y) == water) {
      ASSERT_EQ(open(x, y), water);
    }
    if (std::hypot(x - 80, y - 80) * 30.0 < 350.0) {
      ASSERT_EQ(grown(x, y), water);
    }
  }
}

TEST(ClassRules, WinterCoversMeadowsAndLeavesForest) {
  const ClassRules rules = read_class_rules("life_zones");
  const Grid<LandCoverClass> summer = apply(rules, cone());
  const Grid<LandCoverClass> winter = apply(rules, cone(), {{"winter", 1.0}});
  EXPECT_GT(share(summer, alpine_grass), 0.1);
  EXPECT_EQ(share(winter, alpine_grass), 0.0);
  EXPECT_EQ(share(winter, pasture), 0.0);
  EXPECT_GT(share(winter, forest), 0.2);
  EXPECT_GT(share(winter, snow), share(summer, snow));
}

TEST(ClassRules, TownsAreWhereTheSceneSaysAndNowhereElse) {
  // A plain that falls to the west: level, but no lake.
  const Dem plain = ground(200, [](double e, double) { return 700.0 + 0.0133 * e; });
  const ClassRules rules = read_class_rules("life_zones");
  const glm::dvec2 town = plain.transform.to_crs(60, 140);
  EXPECT_EQ(share(apply(rules, plain, {{"settlement", -1.0}}), settlement), 0.0);
  const Grid<LandCoverClass> with = apply(rules, plain, {{"settlement", -1.0}}, {{town, 900.0}});
  // As large as a circle of that radius, minus the river; ragged by a fifth of the radius.
  EXPECT_NEAR(share(with, settlement) * 6000.0 * 6000.0, 3.14159 * 900.0 * 900.0,
              0.25 * 3.14159 * 900.0 * 900.0);
  for (const auto [x, y] : test::cells(200, 200))
    if (with(x, y) == settlement) {
      ASSERT_LT(std::hypot(x - 60, y - 140) * 30.0, 2600.0);
    }
  EXPECT_EQ(with(60, 140), settlement);
}

TEST(ClassRules, TownsAreNoParametersAnyMore) {
  const test::Folder folder;
  const std::string file = folder.write(
      "r.toml",
      "version = 1\n[parameters]\ntown_1_east = 5\n[[layers]]\nclass = \"forest\"\nwhen = \"1\"\n");
  EXPECT_THAT(test::usage_error([&] { read_class_rules(file); }),
              testing::AllOf(testing::HasSubstr("r.toml:3:"), testing::HasSubstr("town_1_east"),
                             testing::HasSubstr("towns of the scene")));
  for (const char* name : {"town_highest_m", "town_1", "my_town_1_east"})
    EXPECT_FALSE(names_old_town(name)) << name;
}

TEST(ClassRules, VillagesStandOnValleyFloorsAndInClearings) {
  // A trough from north to south with gentle shoulders.
  const Dem dem = ground(240, [](double e, double n) {
    return 650.0 + 0.012 * n + 0.5 * std::max(0.0, std::abs(e) - 900.0) -
           0.35 * std::max(0.0, std::abs(e) - 1700.0);
  });
  const ClassRules rules = read_class_rules("life_zones");
  const Grid<LandCoverClass> some = apply(rules, dem);
  EXPECT_GT(share(some, settlement), 0.001);
  EXPECT_LT(share(some, settlement), 0.1);
  EXPECT_EQ(share(apply(rules, dem, {{"town_highest_m", 500.0}}), settlement), 0.0);
  // No houses in the forest: it ends before them.
  int in_wood = 0;
  for (const auto [x, y] : test::cells({1, 1, 239, 239}))
    if (some(x, y) == settlement && some(x + 1, y) == forest && some(x - 1, y) == forest) ++in_wood;
  EXPECT_EQ(in_wood, 0);
}

// A plain with one known town: fields around it, meadows beyond, and more of them where there are
// no known towns.
TEST(ClassRules, FieldsLieAboutTownsAndMeadowsBetween) {
  const Dem plain = ground(240, [](double e, double) { return 500.0 + 0.015 * e; });
  const ClassRules rules = read_class_rules("life_zones");
  const glm::dvec2 town = plain.transform.to_crs(60, 120);
  const Grid<LandCoverClass> c = apply(rules, plain, {{"settlement", -1.0}}, {{town, 500.0}});
  int fields_near = 0, near = 0, fields_far = 0, meadows_far = 0, far = 0;
  for (const auto [x, y] : test::cells(240, 240)) {
    const double away = glm::length(plain.transform.to_crs(x, y) - town);
    if (away > 700.0 && away < 1200.0) {
      ++near;
      fields_near += c(x, y) == LandCoverClass::valley_floor ? 1 : 0;
    } else if (away > 3000.0) {
      ++far;
      fields_far += c(x, y) == LandCoverClass::valley_floor ? 1 : 0;
      meadows_far += c(x, y) == LandCoverClass::pasture ? 1 : 0;
    }
  }
  EXPECT_GT(fields_near, near * 9 / 10);
  EXPECT_LT(fields_far, far / 50);
  EXPECT_GT(meadows_far, far * 9 / 10);
  // As in the Alps, fields everywhere.
  EXPECT_EQ(
      share(apply(rules, plain, {{"settlement", -1.0}, {"inferred_villages", 1.0}}), valley_floor),
      1.0);
}

// Wooded slopes of one steepness all around, 700 m … 1400 m.
Grid<LandCoverClass> wooded_cone(double slope_deg,
                                 const std::vector<std::pair<std::string, double>>& settings) {
  const double fall = std::tan(slope_deg * 0.017453292519943295);
  return apply(read_class_rules("life_zones"),
               ground(160, [&](double e, double n) { return 1400.0 - fall * std::hypot(e, n); }),
               settings);
}

TEST(ClassRules, CragsStandOutOfWoodedSlopesTheMoreTheSteeper) {
  EXPECT_EQ(share(wooded_cone(22.0, {}), rock), 0.0);
  const double gentle = share(wooded_cone(8.0, {{"crags", 1.0}}), rock);
  const double steep = share(wooded_cone(22.0, {{"crags", 1.0}}), rock);
  EXPECT_GT(gentle, 0.03);
  EXPECT_GT(steep, 1.6 * gentle);
  EXPECT_LT(steep, 0.6);
  EXPECT_GT(share(wooded_cone(22.0, {{"crags", 1.5}}), rock), steep);
}

TEST(ClassRules, ClearingsClimbSteeperSlopes) {
  // Twenty-five degrees are too steep for the usual pasture.
  EXPECT_LT(share(wooded_cone(25.0, {}), pasture), 0.02);
  const double half = share(wooded_cone(25.0, {{"clearings", 0.5}}), pasture);
  const double all = share(wooded_cone(25.0, {{"clearings", 1.0}}), pasture);
  EXPECT_GT(all, half);
  EXPECT_GT(all, 0.3);
  EXPECT_LT(share(wooded_cone(8.0, {{"clearings", -1.0}}), pasture),
            0.2 * share(wooded_cone(8.0, {}), pasture));
}

// Above the line a gentle glacier is white with firn; where it falls steeply, and below the line,
// it shows its ice.
TEST(ClassRules, FirnHidesIceAboveTheLineButNotOnSteps) {
  const std::vector<std::pair<std::string, double>> settings = {
      {"ice_line_m", 3000.0}, {"snowline_m", 9000.0}, {"raggedness", 0.0}};
  const auto shares = [&](double gradient) {
    // A trough that falls to the south, its centre at the line.
    const Dem dem =
        ground(200, [&](double e, double n) { return 3000.0 + gradient * n + 0.0002 * e * e; });
    const Grid<LandCoverClass> c = apply(read_class_rules("life_zones"), dem, settings);
    double firn_above = 0.0, ice_above = 0.0, firn_below = 0.0, ice_below = 0.0;
    for (std::size_t i = 0; i < c.size(); ++i) {
      if (std::abs(static_cast<int>(i % 200) - 100) > 15) continue;
      const bool above = dem.altitude_m[i] > 3250.F;
      if (!above && dem.altitude_m[i] > 2950.F) continue;
      (c[i] == snow ? (above ? firn_above : firn_below) : (above ? ice_above : ice_below)) +=
          c[i] == snow || c[i] == glacier ? 1.0 : 0.0;
    }
    return std::array<double, 4>{firn_above, ice_above, firn_below, ice_below};
  };
  const auto gentle = shares(0.2);
  EXPECT_GT(gentle[0], 20.0 * gentle[1]);
  EXPECT_GT(gentle[3], 100.0);
  EXPECT_EQ(gentle[2], 0.0) << "no firn below the line";
  EXPECT_GT(shares(0.6)[1], 300.0) << "steps of ice above the line";
}

// Above the highest grass there is rubble, even on level ground, and around the tongues of
// glaciers; never in lower forest.
TEST(ClassRules, RubbleLiesAboveTheGrassAndAboutTheIce) {
  const ClassRules rules = read_class_rules("life_zones");
  const Dem gentle = ground(200, [](double, double n) { return 2000.0 + 0.3 * n; });
  const Grid<LandCoverClass> c =
      apply(rules, gentle, {{"raggedness", 0.0}, {"snowline_m", 9000.0}, {"ice_line_m", 9000.0}});
  double highest_grass = 0.0;
  for (std::size_t i = 0; i < c.size(); ++i)
    if (c[i] == alpine_grass)
      highest_grass = std::max(highest_grass, static_cast<double>(gentle.altitude_m[i]));
  EXPECT_GT(highest_grass, 1820.0 + 300.0);
  EXPECT_LT(highest_grass, 1820.0 + 1000.0);

  const Dem trough =
      ground(200, [](double e, double n) { return 2300.0 + 0.2 * n + 0.0003 * e * e; });
  const Grid<LandCoverClass> icy =
      apply(rules, trough, {{"ice_line_m", 2450.0}, {"treeline_m", 2200.0}, {"raggedness", 0.0}});
  const Grid<LandCoverClass> bare =
      apply(rules, trough, {{"ice_line_m", 9000.0}, {"treeline_m", 2200.0}, {"raggedness", 0.0}});
  int rubble = 0;
  for (const auto [x, y] : test::cells({1, 1, 199, 199})) {
    if (icy(x, y) != scree || bare(x, y) == scree) continue;
    ++rubble;
    bool near_ice = false;
    for (int v = -6; v <= 6 && !near_ice; ++v)
      for (int u = -6; u <= 6 && !near_ice; ++u)
        near_ice = icy.contains(x + u, y + v) &&
                   (icy(x + u, y + v) == glacier || icy(x + u, y + v) == snow);
    EXPECT_TRUE(near_ice) << x << ", " << y;
  }
  EXPECT_GT(rubble, 100);
}

TEST(ClassRules, GlaciersFlowDownValleysInTongues) {
  // A valley that falls to the south from a snow field: its ice reaches far below the ice line,
  // that of the adjacent ridges does not.
  const Dem dem =
      ground(200, [](double e, double n) { return 2700.0 + 0.25 * n + 0.00045 * e * e; });
  const Grid<LandCoverClass> c =
      apply(read_class_rules("life_zones"), dem, {{"ice_line_m", 3000.0}, {"raggedness", 0.0}});
  double lowest_ice = 1e9;
  int column = 0;
  for (const auto [x, y] : test::cells(200, 200))
    if (c(x, y) == glacier && static_cast<double>(dem.altitude_m(x, y)) < lowest_ice) {
      lowest_ice = static_cast<double>(dem.altitude_m(x, y));
      column = x;
    }
  EXPECT_LT(lowest_ice, 2850.0);
  EXPECT_NEAR(column, 100, 20);
}

TEST(ClassRules, SpecksGoAndWaterStays) {
  Grid<LandCoverClass> c(40, 40, forest);
  c(10, 10) = rock;
  c(11, 10) = rock;
  c(20, 20) = water;
  for (const auto [x, y] : test::cells({28, 28, 36, 36})) c(x, y) = snow;
  class_rules::remove_specks(c, 5);
  EXPECT_EQ(c(10, 10), forest);
  EXPECT_EQ(c(20, 20), water);
  EXPECT_EQ(c(31, 31), snow);
  EXPECT_EQ(std::count(c.begin(), c.end(), rock), 0);
}

TEST(ClassRules, SameForAnyNumberOfThreads) {
  const ClassRules rules = read_class_rules("life_zones");
  const Grid<LandCoverClass> many = apply(rules, cone());
  const ThreadLimit limit(1);
  EXPECT_EQ(apply(rules, cone()), many);
}

TEST(ClassRules, UnknownSettingNamesTheNearest) {
  const Error e = test::error_of([&] {
    apply(read_class_rules("life_zones"), cone(), {{"tree_line_m", 1.0}});
  });
  EXPECT_EQ(e.kind(), ErrorKind::usage);
  EXPECT_THAT(e.found(), testing::HasSubstr("did you mean \"treeline_m\"?"));
}

// The error of a rules file with this text.
std::string refused(const std::string& text) {
  const test::Folder folder;
  try {
    read_class_rules(folder.write("rules.toml", text));
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::usage);
    const std::string where =
        e.where().substr(std::min(e.where().size(), folder.path().size() + 1));
    return where + " " + e.found();
  }
  return "accepted";
}

TEST(ClassRules, FilesAreRefusedWithTheirPlace) {
  const std::string head = "version = 1\n";
  EXPECT_EQ(refused(head + "[[layers]]\nclass = \"rock\"\nwhen = \"slope > 3\"\n"), "accepted");
  EXPECT_EQ(refused(head + "[[layers]]\nclass = \"rock\"\nwhen = \"slop > 3\"\n"),
            "rules.toml:4:9 unknown name \"slop\"; did you mean \"slope\"?");
  EXPECT_THAT(refused(head + "[[layers]]\nclass = \"rok\"\nwhen = \"1\"\n"),
              testing::HasSubstr(":3:9 unknown class \"rok\"; did you mean \"rock\"?"));
  EXPECT_THAT(refused(head + "[[layers]]\nclass = \"rock\"\n"),
              testing::HasSubstr("\"when\" is missing"));
  EXPECT_THAT(refused(head + "[[layers]]\nclass = \"rock\"\nwhen = \"1\"\nif = \"2\"\n"),
              testing::HasSubstr("unknown key \"if\""));
  EXPECT_THAT(
      refused(head +
              "[terms]\na = \"b + 1\"\nb = \"1\"\n[[layers]]\nclass = \"rock\"\nwhen = \"a\"\n"),
      testing::HasSubstr(":3:6 unknown name \"b\""));
  EXPECT_THAT(
      refused(head + "[terms]\na = \"is_rock\"\n[[layers]]\nclass = \"rock\"\nwhen = \"a\"\n"),
      testing::HasSubstr("the class so far is available only in layers"));
  EXPECT_THAT(refused(head + "[parameters]\nslope = 3\n"), testing::HasSubstr("already in use"));
  EXPECT_THAT(refused(head + "[parameters]\n\"a b\" = 3\n"),
              testing::HasSubstr("the name \"a b\""));
  EXPECT_THAT(refused(head), testing::HasSubstr("\"layers\" is missing"));
  EXPECT_THAT(refused("version = 2\n"), testing::HasSubstr("the number 2"));
  EXPECT_THROW(read_class_rules("alpin"), Error);
}

}  // namespace
}  // namespace belvedere
