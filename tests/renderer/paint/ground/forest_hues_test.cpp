#include "renderer/paint/ground/forest_hues.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

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
