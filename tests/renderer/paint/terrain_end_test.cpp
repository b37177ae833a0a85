#include "renderer/paint/terrain_end.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/grids.h"
#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere {
namespace {

TEST(TerrainEnd, StandsInAirBeforeItDissolves) {
  const TerrainEnd inside = terrain_end_at(4000.0F, 4000.0);
  EXPECT_EQ(inside.air, 0.0F);
  EXPECT_EQ(inside.dissolved, 0.0F);
  const TerrainEnd centre = terrain_end_at(2000.0F, 4000.0);
  EXPECT_NEAR(centre.air, 0.43F, 1e-6F);
  EXPECT_EQ(centre.dissolved, 0.0F) << "only the last .38 of the fade";
  EXPECT_NEAR(terrain_end_at(760.0F, 4000.0).dissolved, 0.5F, 1e-6F);
  const TerrainEnd end = terrain_end_at(0.0F, 4000.0);
  EXPECT_NEAR(end.air, 0.86F, 1e-6F);
  EXPECT_EQ(end.dissolved, 1.0F);
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
  const TerrainEnd crest = terrain_end_at(1000.0F, 4000.0);
  EXPECT_EQ(with_sides(crest, 0.0F, 1.0F).dissolved, crest.dissolved);
  EXPECT_EQ(with_sides(crest, 1.0F, 0.0F).dissolved, 1.0F);
  EXPECT_EQ(with_sides({}, 1.0F, 1.0F).dissolved, 1.0F) << "however ragged the line";
  EXPECT_LT(with_sides({}, 0.5F, 1.0F).dissolved, with_sides({}, 0.5F, -1.0F).dissolved);
}

using test::make_slope;

TEST(RangeEdges, SkyCountsAsALittleFartherThanTheTerrainBelow) {
  GuidanceBuffers g = make_slope(3, 8, LandCoverClass::forest, {0.0F, 0.0F, 1.0F}, 10.0F);
  for (int y = 0; y < 4; ++y) g.depth_m(1, y) = std::numeric_limits<float>::infinity();
  const Grid<float> logs = log_depths(g, 3);
  EXPECT_EQ(logs(1, 4), std::log(20000.0F));
  EXPECT_EQ(logs(1, 3), std::log(1.02F * 20000.0F));
  EXPECT_EQ(logs(1, 1), logs(1, 3));
  EXPECT_NE(logs(1, 0), logs(1, 1)) << "beyond its reach it is as far as unknown sky";
}

TEST(RangeEdges, MistLiesOnTheFarSideAndShadeOnTheNear) {
  const RangeEdge far_side = range_edge(0.05F, 0.0F, 0.0F, 1.0F);
  EXPECT_NEAR(far_side.mist, 0.15F, 1e-6F);
  EXPECT_EQ(far_side.dark, 0.0F);
  const RangeEdge near_side = range_edge(-0.1F, 0.0F, 0.0F, 1.0F);
  EXPECT_EQ(near_side.mist, 0.0F);
  EXPECT_NEAR(near_side.dark, 0.15F, 1e-6F);
  EXPECT_NEAR(range_edge(9.0F, 0.0F, 0.0F, 1.0F).mist, 0.35F, 1e-6F) << "it never closes";
  EXPECT_NEAR(range_edge(9.0F, 2.0F, 0.0F, 1.0F).mist, 0.55F, 1e-6F)
      << "among far ranges it is denser";
  EXPECT_NEAR(range_edge(9.0F, 0.0F, 1.0F, 1.0F).mist, 0.25F * 0.35F, 1e-6F) << "crests stay clear";
  EXPECT_EQ(range_edge(9.0F, 0.0F, 0.0F, 0.0F).mist, 0.0F);
  EXPECT_NEAR(range_edge(-9.0F, 0.0F, 0.0F, 2.0F).dark, 0.5F, 1e-6F);
}

TEST(RangeEdges, MistOfHollowsAndEdgesTogetherIsAVeil) {
  EXPECT_NEAR(edge_mist_beside(0.0F, 1.0F), 0.4F, 1e-6F);
  EXPECT_NEAR(1.0F - (1.0F - 0.25F) * (1.0F - edge_mist_beside(0.25F, 1.0F)), 0.4F, 1e-6F);
  EXPECT_EQ(edge_mist_beside(0.5F, 1.0F), 0.0F) << "already thicker";
  EXPECT_NEAR(edge_mist_beside(0.0F, 3.0F), 0.8F, 1e-6F);
  EXPECT_EQ(edge_mist_beside(0.0F, 0.0F), 0.0F);
  EXPECT_EQ(edge_mist_beside(1.0F, 3.0F), 0.0F);
}

TEST(RangeEdges, AccentsStandOnTheNearerSideAndNeverOnTheSkyline) {
  GuidanceBuffers g = make_slope(9, 20, LandCoverClass::pasture, {0.0F, 0.0F, 1.0F}, 10.0F);
  for (const auto [x, y] : test::cells(9, 10)) g.depth_m(x, y) = 40000.0F;
  const Grid<float> logs = log_depths(g, 1);
  EXPECT_EQ(accent_at(g, logs, 4, 10, 1), 0.8F);
  EXPECT_EQ(accent_at(g, logs, 4, 9, 1), 0.0F);
  EXPECT_EQ(accent_at(g, logs, 4, 13, 1), 0.0F);
  for (float& t : g.tone) t = 0.2F;
  EXPECT_EQ(accent_at(g, logs, 4, 10, 1), -0.8F) << "dark in the shade";
  for (int x = 0; x < 9; ++x) g.depth_m(x, 7) = std::numeric_limits<float>::infinity();
  EXPECT_EQ(accent_at(g, logs, 4, 10, 1), 0.0F);
}

TEST(RangeEdges, AccentsFollowRelief) {
  GuidanceBuffers g = make_slope(5, 5, LandCoverClass::pasture, {0.0F, 0.0F, 1.0F}, 10.0F);
  const Grid<float> logs = log_depths(g, 1);
  const auto accent = [&](LandCoverClass id, float relief_m) {
    g.land_cover(2, 2) = id;
    g.relief_s_m(2, 2) = relief_m;
    return accent_at(g, logs, 2, 2, 1);
  };
  EXPECT_EQ(accent(LandCoverClass::rock, 18.0F), 0.9F);
  EXPECT_NEAR(accent(LandCoverClass::rock, -4.5F), -0.45F, 1e-6F);
  EXPECT_EQ(accent(LandCoverClass::scree, 18.0F), 0.6F);
  EXPECT_EQ(accent(LandCoverClass::pasture, -18.0F), -0.35F);
}

}  // namespace
}  // namespace belvedere
