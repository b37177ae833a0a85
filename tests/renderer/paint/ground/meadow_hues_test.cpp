#include "renderer/paint/ground/meadow_hues.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

using enum LandCoverClass;

constexpr Patches even{0.0F, 0.0F, 0.0F, 0.0F};

TEST(MeadowHues, HollowsAreLushAndSunnyRidgesDry) {
  MeadowPosition hollow{.slope_deg = 15.0F,
                        .relief_s_m = -8.0F,
                        .relief_m_m = -35.0F,
                        .valley_height_m = 300.0F,
                        .above_treeline_m = -700.0F};
  MeadowPosition ridge = hollow;
  ridge.sunny = 0.8F;
  ridge.relief_s_m = 8.0F;
  ridge.relief_m_m = 35.0F;
  const MeadowMix wet = meadow_mix(pasture, hollow, even);
  const MeadowMix dry = meadow_mix(pasture, ridge, even);
  EXPECT_GT(wet.lush, 0.9F);
  EXPECT_EQ(wet.dry, 0.0F);
  EXPECT_GT(dry.dry, 0.9F);
  EXPECT_EQ(dry.lush, 0.0F);
  hollow.sunny = -0.5F;
  ridge.sunny = -0.5F;
  EXPECT_LT(meadow_mix(pasture, ridge, even).dry, dry.dry)
      << "what is turned away from the sun dries less";
  // Lush grass is greener than dry grass, not only darker.
  const glm::vec3 a = meadow_hue(wet, 1.0F);
  const glm::vec3 b = meadow_hue(dry, 1.0F);
  EXPECT_GT(a.g / a.r, b.g / b.r + 0.15F);
}

TEST(MeadowHues, TurfIsHighAndMeadowsAreMownLowAndLevel) {
  const MeadowPosition village{
      .slope_deg = 5.0F, .valley_height_m = 30.0F, .above_treeline_m = -1000.0F};
  MeadowPosition alp = village;
  alp.above_treeline_m = 600.0F;
  EXPECT_EQ(meadow_mix(pasture, village, even).mown, 1.0F);
  EXPECT_EQ(meadow_mix(pasture, village, even).high, 0.0F);
  EXPECT_EQ(meadow_mix(pasture, alp, even).mown, 0.0F);
  EXPECT_EQ(meadow_mix(alpine_grass, alp, even).high, 1.0F);
  EXPECT_EQ(meadow_mix(alpine_grass, village, even).mown, 0.0F) << "not mown at that altitude";
  MeadowPosition steep = village;
  steep.slope_deg = 25.0F;
  EXPECT_EQ(meadow_mix(pasture, steep, even).mown, 0.0F);
}

TEST(MeadowHues, OnlyGrassHasThemAndStrengthZeroLeavesColourAlone) {
  const MeadowPosition wet{.relief_s_m = -9.0F, .relief_m_m = -60.0F, .above_treeline_m = 300.0F};
  for (const LandCoverClass id : {forest, rock, snow, water, settlement, scree, glacier, sand}) {
    const MeadowMix mix = meadow_mix(id, wet, even);
    EXPECT_EQ(meadow_hue(mix, 1.0F), glm::vec3(1.0F)) << class_name(id);
    EXPECT_EQ(mix.mown, 0.0F);
  }
  EXPECT_EQ(meadow_hue(meadow_mix(pasture, wet, even), 0.0F), glm::vec3(1.0F));
  EXPECT_NE(meadow_hue(meadow_mix(pasture, wet, even), 1.0F), glm::vec3(1.0F));
  // A valley floor is low everywhere: that alone does not make it a marsh.
  const MeadowPosition floor{.relief_m_m = -60.0F, .above_treeline_m = -1200.0F};
  EXPECT_EQ(meadow_mix(valley_floor, floor, even).lush, 0.0F);
}

// South of the equator the noon sun stands in the north.
TEST(MeadowHues, TheSunnySideIsTheEquators) {
  GuidanceBuffers g;
  g.normal_smooth = Grid<glm::vec3>(1, 1, glm::vec3(0.0F, -0.45F, 0.89F));  // falls to the south
  g.slope_deg = g.relief_s_m = g.relief_m_m = g.valley_height_m = Grid<float>(1, 1, 0.0F);
  g.altitude_m = Grid<float>(1, 1, 1500.0F);
  EXPECT_NEAR(meadow_position(g, 0, 1820.0, 1.0F).sunny, 0.9F, 1e-6F);
  EXPECT_NEAR(meadow_position(g, 0, 1820.0, -1.0F).sunny, -0.9F, 1e-6F);
  EXPECT_NEAR(meadow_position(g, 0, 1820.0, 1.0F).above_treeline_m, -320.0F, 1e-4F);
}

TEST(ForestHues, GulliesAreDarkAndBlueRibsLightAndWarm) {
  const Patches even{0.0F, 0.0F, 0.0F, 0.0F};
  const ForestTurn gully = forest_turn(-8.0F, -40.0F, 0.6F, even, 1.0F);
  const ForestTurn rib = forest_turn(8.0F, 40.0F, 0.6F, even, 1.0F);
  EXPECT_LT(gully.tone, -0.08F);
  EXPECT_GT(rib.tone, 0.08F);
  EXPECT_LT(gully.factor.r, gully.factor.b - 0.08F);
  EXPECT_GT(rib.factor.r, rib.factor.b + 0.07F);
  EXPECT_GT(forest_turn(-8.0F, -40.0F, 0.05F, even, 1.0F).tone, -0.03F) << "shade keeps its forms";
  const ForestTurn level = forest_turn(0.0F, 0.0F, 0.6F, even, 1.0F);
  EXPECT_EQ(level.tone, 0.0F);
  EXPECT_EQ(level.factor, glm::vec3(1.0F));
  EXPECT_EQ(forest_turn(-8.0F, -40.0F, 0.6F, even, 0.0F).factor, glm::vec3(1.0F));
}

}  // namespace

}  // namespace belvedere
