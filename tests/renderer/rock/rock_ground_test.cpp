#include "renderer/rock/rock_ground.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/renderer/rock/rock_wall.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

TEST(RockGround, SpursStandInTheMeadowAndGulliesLetDebrisUp) {
  // Half rock, half meadow around; more rock above than below: the foot of a wall.
  const auto shown = [](LandCoverClass mapped, float stands) {
    return rock_border(
        {.mapped = mapped, .rock = 0.5F, .turf = 0.4F, .above = 0.6F, .stands = stands});
  };
  EXPECT_EQ(shown(rock, 0.4F), rock);
  EXPECT_EQ(shown(rock, -0.4F), scree);
  EXPECT_EQ(shown(alpine_grass, 0.4F), rock);
  EXPECT_EQ(shown(alpine_grass, -0.4F), alpine_grass);
  EXPECT_EQ(shown(scree, 0.4F), rock);
}

TEST(RockGround, NothingChangesFarFromABorder) {
  for (const float stands : {-0.6F, 0.6F}) {
    EXPECT_EQ(rock_border({.mapped = rock, .rock = 1.0F, .stands = stands}), rock);
    for (const LandCoverClass id : {alpine_grass, scree, snow, pasture, shrub})
      EXPECT_EQ(rock_border({.mapped = id, .rock = 0.03F, .stands = stands}), id);
  }
}

// Man-made classes, forest and water stay.
TEST(RockGround, WoodsWatersAndVillagesStay) {
  for (const LandCoverClass id : {forest, water, settlement, valley_floor, glacier})
    EXPECT_EQ(rock_border({.mapped = id, .rock = 0.8F, .stands = 0.6F}), id);
}

TEST(RockGround, WhereSnowIsNearItFillsTheGullies) {
  EXPECT_EQ(rock_border({.mapped = rock, .rock = 0.5F, .snow = 0.5F, .stands = -0.5F}), snow);
  EXPECT_EQ(rock_border({.mapped = rock,
                         .rock = 0.5F,
                         .turf = 0.6F,
                         .snow = 0.5F,
                         .above = 0.6F,
                         .stands = -0.5F}),
            scree);
  EXPECT_EQ(rock_border({.mapped = rock, .rock = 0.5F, .stands = -0.5F}), rock)
      << "an edge above grass: there is no debris";
}

TEST(RockGround, CrestsStandOutOfSteepSnow) {
  const auto at = [](float slope_deg, float stands) {
    return rock_border({.mapped = snow, .slope_deg = slope_deg, .stands = stands});
  };
  EXPECT_EQ(at(50.0F, 0.5F), rock);
  EXPECT_EQ(at(50.0F, -0.2F), snow);
  EXPECT_EQ(at(30.0F, 0.6F), snow);
}

// Near walls are steeper than their elevation data: ribs show on gentler ones, the broader the
// steeper; snow fills the gullies and hollows between, and whole walls.
TEST(RockGround, RibsOfNearWallsShowInSnow) {
  const auto at = [](float slope_deg, float rib, float funnel, float wall) {
    return rock_border({.mapped = snow,
                        .slope_deg = slope_deg,
                        .funnel = funnel,
                        .close = 1.0F,
                        .rib = rib,
                        .wall = wall});
  };
  EXPECT_EQ(at(38.0F, 0.9F, 0.0F, 0.0F), rock);
  EXPECT_EQ(at(38.0F, 0.0F, 0.0F, 0.0F), snow);
  EXPECT_EQ(at(38.0F, 0.45F, 0.0F, 0.0F), rock);
  EXPECT_EQ(at(34.0F, 0.45F, 0.0F, 0.0F), snow);
  EXPECT_EQ(at(34.0F, 0.45F, 1.0F, 0.5F), rock);
  EXPECT_EQ(at(38.0F, 0.45F, -1.0F, -1.0F), snow);
  EXPECT_EQ(at(12.0F, 1.0F, 1.5F, 1.5F), snow);
  const auto of_ice = [](float slope_deg, float close) {
    return rock_border(
        {.mapped = glacier, .slope_deg = slope_deg, .close = close, .rib = 0.9F, .wall = 0.5F});
  };
  EXPECT_EQ(of_ice(38.0F, 1.0F), rock);
  EXPECT_EQ(of_ice(38.0F, 0.0F), glacier);
  EXPECT_EQ(of_ice(24.0F, 1.0F), glacier);
  // Turf clings to steeper ground, and none of this is so from afar.
  for (const LandCoverClass id : {scree, alpine_grass, pasture, shrub}) {
    const auto of = [&](float slope_deg, float rib, float close) {
      return rock_border({.mapped = id, .slope_deg = slope_deg, .close = close, .rib = rib});
    };
    EXPECT_EQ(of(42.0F, 0.9F, 1.0F), rock);
    EXPECT_EQ(of(42.0F, 0.0F, 1.0F), id);
    EXPECT_EQ(of(31.0F, 0.9F, 1.0F), id);
    EXPECT_EQ(of(42.0F, 0.9F, 0.0F), id);
  }
}

// Beds lie one above the other with one dip, and stand out unlike far.
TEST(RockGround, BedsShapeRibsInTurf) {
  for (const float metres_per_unit : {3.0F, 11.0F}) {
    double sum = 0.0;
    double squares = 0.0;
    for (int k = 0; k < 4000; ++k) {
      const float bed = standing_bed(1000.0 + 0.7 * k, 5000.0, 900.0, metres_per_unit, 0.0F);
      ASSERT_LE(std::abs(bed), 1.0F);
      sum += static_cast<double>(bed);
      squares += static_cast<double>(bed) * bed;
    }
    EXPECT_NEAR(sum / 4000.0, 0.0, 0.3);
    EXPECT_GT(squares / 4000.0, 0.1);
    // Along its dip a bed stays the same.
    EXPECT_NEAR(standing_bed(1500.0, 0.0, 0.0, metres_per_unit, 0.0F),
                standing_bed(1500.0 - 26.0, 100.0, 0.0, metres_per_unit, 0.0F), 1e-4F);
  }
  const auto at = [](float bedded, float bed) {
    return rock_border({.mapped = alpine_grass, .rock = 0.45F, .bedded = bedded, .bed = bed});
  };
  EXPECT_EQ(at(0.0F, 1.0F), alpine_grass);
  EXPECT_EQ(at(1.0F, 1.0F), rock);
  EXPECT_EQ(at(1.0F, -1.0F), alpine_grass);
}

TEST(RockGround, DebrisReachesUpBeneathFunnels) {
  const auto at = [](float funnel, float cones) {
    return rock_border(
        {.mapped = rock, .rock = 0.5F, .above = 0.6F, .funnel = funnel, .cones = cones});
  };
  EXPECT_EQ(at(1.0F, 1.0F), rock);
  EXPECT_EQ(at(-1.5F, 1.0F), scree);
  EXPECT_EQ(at(-1.5F, 0.1F), rock);
}

TEST(RockGround, SharesAreOfTheOwnSurface) {
  GuidanceBuffers g = test::make_wall(120, 80, 1.0);
  // The right half is meadow, far behind.
  for (int y = 0; y < 80; ++y)
    for (int x = 60; x < 120; ++x) {
      g.land_cover(x, y) = alpine_grass;
      g.depth_m(x, y) *= 1.5F;
    }
  const RockAround around = look_around_rock({g, 1, {0, 0}}, 1.0, {0, 0, 120, 80});
  EXPECT_FLOAT_EQ(around.rock(58, 40), 1.0F);
  EXPECT_FLOAT_EQ(around.turf(58, 40), 0.0F);
  EXPECT_FLOAT_EQ(around.rock(61, 40), 0.0F);
  EXPECT_FLOAT_EQ(around.turf(61, 40), 1.0F);
}

}  // namespace
}  // namespace belvedere
