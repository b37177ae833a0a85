#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "terrain/cover/class_rules.h"
#include "tests/grids.h"
#include "tests/terrain/cover/class_rules_ground.h"

// Class rules with the local climate.
namespace belvedere {
namespace {

using enum LandCoverClass;
using test::cone;
using test::ground;
using test::share;

// Climate of one place everywhere, with other lines and water.
RuleClimate climate(float treeline_m, float snow_m, float moisture) {
  RuleClimate c = alpine_climate();
  c.treeline_m(0, 0) = treeline_m;
  c.ice_line_m(0, 0) = c.snow_line_m(0, 0) = snow_m;
  for (Grid<float>& level : c.moisture) level(0, 0) = moisture;
  return c;
}

Grid<LandCoverClass> apply_in(const RuleClimate& where, const Dem& dem,
                              const std::vector<std::pair<std::string, double>>& settings = {}) {
  ClassRuleParameters parameters;
  parameters.settings = settings;
  parameters.seed = 7;
  parameters.climate = where;
  return apply_class_rules(read_class_rules("life_zones"), parameters, dem, silent_progress())
      .classes.cells;
}

// Mean altitude of the highest tenth of forest cells; 0 without forest.
double forest_top(const Grid<LandCoverClass>& classes, const Dem& dem) {
  std::vector<float> altitudes;
  for (std::size_t i = 0; i < classes.size(); ++i)
    if (classes[i] == forest) altitudes.push_back(dem.altitude_m[i]);
  if (altitudes.empty()) return 0.0;
  std::sort(altitudes.rbegin(), altitudes.rend());
  const std::size_t count = std::max<std::size_t>(1, altitudes.size() / 10);
  return std::accumulate(altitudes.begin(), altitudes.begin() + static_cast<std::ptrdiff_t>(count),
                         0.0) /
         static_cast<double>(count);
}

TEST(LifeZones, TheTreelineIsThatOfTheClimateUnlessTheSceneHasItsOwn) {
  const Dem dem =
      ground(300, [](double e, double n) { return 3700.0 - 0.4663 * std::hypot(e, n); });
  for (const float treeline : {2200.F, 3000.F}) {
    EXPECT_NEAR(forest_top(apply_in(climate(treeline, 5500.F, 1.F), dem), dem), treeline, 200.0)
        << treeline;
    EXPECT_NEAR(
        forest_top(apply_in(climate(treeline, 5500.F, 1.F), dem, {{"treeline_m", 2600.0}}), dem),
        2600.0, 200.0);
  }
}

TEST(LifeZones, ForestClimbsHigherOnSunnySlopes) {
  const Dem dem =
      ground(240, [](double e, double n) { return 2900.0 - 0.4663 * std::hypot(e, n); });
  const Grid<LandCoverClass> c = apply_in(climate(1900.F, 4500.F, 1.F), dem, {{"raggedness", 0.0}});
  const auto highest = [&](int from, int to) {
    float top = 0.F;
    for (const auto [x, y] : test::cells({100, from, 140, to}))
      if (c(x, y) == forest) top = std::max(top, dem.altitude_m(x, y));
    return top;
  };
  EXPECT_GT(highest(120, 240), highest(0, 120) + 100.F);  // rows run south
}

TEST(LifeZones, NoSnowWhereTheLineIsAboveAllGround) {
  const Dem volcano =
      ground(240, [](double e, double n) { return 3800.0 - 0.6 * std::hypot(e, n); });
  const Grid<LandCoverClass> dry = apply_in(climate(3000.F, 4600.F, 0.9F), volcano);
  EXPECT_EQ(share(dry, snow) + share(dry, glacier), 0.0);
  const Grid<LandCoverClass> wet = apply_in(climate(2000.F, 2600.F, 1.F), volcano);
  EXPECT_GT(share(wet, snow) + share(wet, glacier), 0.01);
}

TEST(LifeZones, WhereWaterIsScarceForestGivesWayToBushesGrassAndSand) {
  const Dem hills = ground(240, [](double e, double n) {
    return 900.0 + 120.0 * std::cos(e / 500.0) * std::cos(n / 700.0) + 0.02 * e;
  });
  const auto on = [&](const Dem& dem, float moisture) {
    return apply_in(climate(3500.F, 5000.F, moisture), dem,
                    {{"settlement", -1.0}, {"clearings", -1.0}});
  };
  const auto shares = [&](float moisture) { return on(hills, moisture); };
  const auto wet = shares(1.F);
  const auto open = shares(0.62F);
  const auto bushes = shares(0.5F);
  const auto steppe = shares(0.36F);
  const auto desert = shares(0.08F);
  EXPECT_GT(share(wet, forest), 0.5);
  EXPECT_GT(share(open, forest), 0.15) << "woods stand on in patches";
  EXPECT_GT(share(open, shrub), 0.1);
  EXPECT_LT(share(bushes, forest), 0.25);
  EXPECT_GT(share(bushes, shrub), 0.3);
  EXPECT_GT(share(steppe, alpine_grass), 0.4);
  EXPECT_LT(share(desert, forest), 0.005) << "only poplars at streams";
  EXPECT_GT(share(desert, sand) + share(desert, scree) + share(desert, rock), 0.7);
  const Dem slope = ground(240, [](double e, double n) {
    return 1500.0 + 0.45 * n + 30.0 * std::cos(e / 300.0);
  });  // 24°
  EXPECT_GT(share(on(slope, 0.08F), rock), 0.6) << "nothing holds soil there";
  EXPECT_LT(share(on(slope, 1.F), rock), 0.1);
}

TEST(LifeZones, TheDatesSnowLiesOnOpenGroundAboveItsLine) {
  const Dem dem =
      ground(240, [](double e, double n) { return 2900.0 - 0.4663 * std::hypot(e, n); });
  RuleClimate october = climate(1820.F, 4000.F, 1.F);
  october.season_snow_m(0, 0) = 2100.F;
  const Grid<LandCoverClass> c = apply_in(october, dem);
  double above = 0.0;
  double white = 0.0;
  for (std::size_t i = 0; i < c.size(); ++i) {
    if (dem.altitude_m[i] > 2450.F) above += 1.0, white += c[i] == snow ? 1.0 : 0.0;
    if (dem.altitude_m[i] < 1600.F) {
      ASSERT_NE(c[i], snow);
    }
  }
  EXPECT_GT(white / above, 0.7);
}

TEST(ClassRules, PartsAreGivenWhatTheWholeFinds) {
  const ClassRules rules = read_class_rules("life_zones");
  ClassRuleParameters parameters;
  // A treeline that rises to the east: altitudes left open depend on it at the centre of the map.
  parameters.climate.line_posts = {1000.0, 5000.0, 7200.0, 7200.0};
  for (Grid<float>* line : {&parameters.climate.treeline_m, &parameters.climate.ice_line_m,
                            &parameters.climate.snow_line_m, &parameters.climate.season_snow_m})
    *line = Grid<float>(2, 1, (*line)(0, 0));
  parameters.climate.treeline_m(0, 0) = 1500.F;
  parameters.climate.treeline_m(1, 0) = 1900.F;
  parameters.settings = {{"treeline_m", 0.0}, {"town_highest_m", 0.0}, {"floor_highest_m", 1111.0}};
  const ClassRuleParameters parts = parameters_for_parts(rules, parameters, cone());
  std::vector<float> row(240);
  fill_climate_row(parameters.climate, ClimateVariable::treeline, cone().transform, 120, 240,
                   cone().altitude_m.row(120), row.data());
  const auto setting = [&](const std::string& name) {
    const auto at = std::find_if(parts.settings.begin(), parts.settings.end(),
                                 [&](const auto& p) { return p.first == name; });
    return at == parts.settings.end() ? std::nan("") : at->second;
  };
  EXPECT_EQ(setting("town_highest_m"), row[120] - 520.0);
  EXPECT_EQ(setting("floor_highest_m"), 1111.0) << "what is said holds";
  ASSERT_TRUE(parts.sites.has_value());
  // Applied to the whole itself, nothing changes.
  EXPECT_EQ(apply_class_rules(rules, parts, cone(), silent_progress()).classes.cells,
            apply_class_rules(rules, parameters, cone(), silent_progress()).classes.cells);
}

}  // namespace
}  // namespace belvedere
