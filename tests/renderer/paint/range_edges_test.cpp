#include "renderer/paint/range_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere {
namespace {

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

TEST(RangeEdges, AccentsStandOnTheNearerSideAndNeverOnTheSkyline) {
  GuidanceBuffers g = make_slope(9, 20, LandCoverClass::pasture, {0.0F, 0.0F, 1.0F}, 10.0F);
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 9; ++x) g.depth_m(x, y) = 40000.0F;
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
