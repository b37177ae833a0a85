#include "renderer/paint/terrain_end.h"

#include <gtest/gtest.h>

#include <cmath>

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

// Data of 10 × 10 km, seen from the south; 10 m a unit.
TerrainSides square() { return {{0.0, 0.0}, {10000.0, 10000.0}, {5000.0, -5000.0}}; }

TEST(TerrainSides, FadeOverAWidthOfTheSheet) {
  const auto share = [](double east_m, double north_m, double from_left_units) {
    return side_share(square(), {.position = {east_m, north_m},
                                 .metres_per_unit = 10.0,
                                 .from_left_units = from_left_units,
                                 .sheet_width_units = 1400.0});
  };
  EXPECT_EQ(share(5000.0, 5000.0, 700.0), 0.0F) << "in the middle";
  EXPECT_NEAR(share(1.0, 9000.0, 300.0), 1.0F, 0.01F);
  // 750 m from the left edge, across the line of sight: half of 150 units.
  const double cosine = 14000.0 / std::hypot(14000.0, 4250.0);
  EXPECT_NEAR(share(750.0, 9000.0, 300.0), 1.0 - 75.0 / cosine / 150.0, 0.01);
  EXPECT_NEAR(share(9250.0, 9000.0, 1100.0), share(750.0, 9000.0, 300.0), 1e-5F);
  EXPECT_EQ(share(5000.0, 9990.0, 700.0), 0.0F) << "the far edge lies across the line of sight";
  EXPECT_EQ(share(750.0, 9000.0, 10.0), 0.0F) << "a cut outside the picture";
}

TEST(TerrainSides, LeaveNothingOfACrestAtTheCut) {
  const TerrainEnd crest = terrain_end_at(0.0F, 4000.0, 1.0F);
  EXPECT_EQ(with_sides(crest, 0.0F, 1.0F).dissolved, crest.dissolved);
  EXPECT_EQ(with_sides(crest, 1.0F, 0.0F).dissolved, 1.0F);
  EXPECT_EQ(with_sides({}, 1.0F, 1.0F).dissolved, 1.0F) << "however ragged the line";
  EXPECT_LT(with_sides({}, 0.5F, 1.0F).dissolved, with_sides({}, 0.5F, -1.0F).dissolved);
}

}  // namespace
}  // namespace belvedere
