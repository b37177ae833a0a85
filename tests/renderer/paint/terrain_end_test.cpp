#include "renderer/paint/terrain_end.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

TEST(TerrainEnd, StandsInAirBeforeItDissolves) {
  const TerrainEnd inside = terrain_end_at(4000.0F, 4000.0, 0.0F);
  EXPECT_EQ(inside.air, 0.0F);
  EXPECT_EQ(inside.dissolved, 0.0F);
  const TerrainEnd centre = terrain_end_at(2000.0F, 4000.0, 0.0F);
  EXPECT_NEAR(centre.air, 0.43F, 1e-6F);
  EXPECT_EQ(centre.dissolved, 0.0F) << "only the last .38 of the fade";
  const TerrainEnd strip = terrain_end_at(760.0F, 4000.0, 0.0F);
  EXPECT_NEAR(strip.dissolved, 0.5F, 1e-6F);
  const TerrainEnd end = terrain_end_at(0.0F, 4000.0, 0.0F);
  EXPECT_NEAR(end.air, 0.86F, 1e-6F);
  EXPECT_EQ(end.dissolved, 1.0F);
}

TEST(TerrainEnd, KeepsPartOfACrest) {
  EXPECT_NEAR(terrain_end_at(0.0F, 4000.0, 1.0F).dissolved, 0.6F, 1e-6F);
  EXPECT_NEAR(terrain_end_at(0.0F, 4000.0, 0.5F).dissolved, 0.8F, 1e-6F);
  EXPECT_EQ(terrain_end_at(0.0F, 4000.0, -1.0F).dissolved, 1.0F) << "hollows go as flats do";
  EXPECT_EQ(terrain_end_at(0.0F, 4000.0, 1.0F).air, terrain_end_at(0.0F, 4000.0, 0.0F).air);
}

}  // namespace
}  // namespace belvedere
