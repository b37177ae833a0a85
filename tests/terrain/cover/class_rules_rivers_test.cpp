#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "terrain/cover/class_rules.h"
#include "tests/terrain/cover/class_rules_ground.h"

namespace belvedere {
namespace {

using enum LandCoverClass;
using test::ground;
using test::share;

// A valley of 52 km² that falls from north to south, its sides rising by a fifth.
const Dem& valley() {
  static const Dem dem =
      ground(240, [](double e, double n) { return 700.0 + 0.02 * n + 0.2 * std::abs(e); });
  return dem;
}

TEST(ClassRulesRivers, InferredRiversAreLinesWhereTheRulesHaveThem) {
  ClassRules rules{"toy", {{"speck_cells", 0.0}}, {}, {{pasture, "1"}, {water, "northing < 0"}}};
  const auto rivers = [&](const std::string& where, bool inferred = true) {
    rules.rivers = where;
    ClassRuleParameters parameters;
    parameters.rivers = inferred;
    return apply_class_rules(rules, parameters, valley(), silent_progress()).inferred_rivers;
  };
  EXPECT_TRUE(rivers("").empty());
  EXPECT_TRUE(rivers("0").empty());
  EXPECT_TRUE(rivers("1", false).empty()) << "a map has them";
  const std::vector<CoverRiver> all = rivers("valley_height < 60");
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].painted_as, water);
  const double centre = valley().transform.to_crs(120, 0).x;
  for (const glm::dvec2 position : all[0].positions) {
    EXPECT_NEAR(position.x, centre, 31.0);
    EXPECT_GT(position.y, -70.0) << "below lies a lake";
  }
  EXPECT_NEAR(all[0].positions.back().y, -40.0, 40.0);
  // Where the rules put them, by an expression and by the class.
  for (const CoverRiver& river : rivers("northing > 1000"))
    for (const glm::dvec2 position : river.positions) EXPECT_GT(position.y, 980.0);
  EXPECT_TRUE(rivers("not is_pasture").empty());
  rules.rivers = "northing >";
  EXPECT_THROW(apply_class_rules(rules, {}, valley(), silent_progress()), Error);
}

TEST(ClassRulesRivers, LifeZonesHaveRiversDownToTheRimWhereRainFeedsThem) {
  const ClassRules rules = read_class_rules("life_zones");
  const auto rivers = [&](float moisture, float temperature_c = 9.F) {
    ClassRuleParameters parameters;
    for (Grid<float>& level : parameters.climate.temperature_c) level(0, 0) = temperature_c;
    parameters.settings = {{"settlement", -1.0}};
    for (Grid<float>& level : parameters.climate.moisture) level(0, 0) = moisture;
    return apply_class_rules(rules, parameters, valley(), silent_progress());
  };
  const LandCover wet = rivers(1.F);
  ASSERT_EQ(wet.inferred_rivers.size(), 1U);
  const CoverRiver& river = wet.inferred_rivers[0];
  EXPECT_LT(river.positions.back().y, valley().transform.to_crs(0, 237).y);
  EXPECT_EQ(river.half_width_m.front(), 0.F);
  EXPECT_GT(river.half_width_m.back(), 11.F);
  EXPECT_EQ(share(wet.classes.cells, water), 0.0) << "the cells have no stairs of it";
  EXPECT_TRUE(rivers(0.08F, 18.F).inferred_rivers.empty());
  EXPECT_EQ(rivers(0.08F, 4.F).inferred_rivers.size(), 1U) << "snow lasts above cold deserts";
}

}  // namespace
}  // namespace belvedere
