#include "renderer/compose/view_measures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/compose/view_candidates.h"
#include "tests/renderer/compose/synthetic_region.h"

namespace belvedere {
namespace {

ViewShape view_of(const CoarseGround& ground, double east_km, double north_km, double azimuth_deg,
                  double far_m, double lone = 0.0) {
  const ViewShape view{.viewer = test::position_km(east_km, north_km),
                       .azimuth_deg = azimuth_deg,
                       .near_m = 0.42 * far_m,
                       .far_m = far_m,
                       .crest_m = 0.8 * far_m};
  const auto laid = lay_out(ground, view, lone);
  EXPECT_TRUE(laid);
  return laid.value_or(view);
}

TEST(ViewMeasures, OfAConeOnAPlain) {
  const CoarseGround ground = test::cone_region();
  const ViewShape view = view_of(ground, 30.0, -10.0, 0.0, 56000.0, 1.0);
  const Massifs massifs = find_massifs(ground);
  const ViewMeasures m = measure_view(ground, view, massifs.anchors);
  EXPECT_TRUE(m.anchors[0].inside);
  EXPECT_EQ(m.anchors[0].seen, 1.0);
  EXPECT_NEAR(m.anchors[0].position.x, 0.5, 0.01);
  EXPECT_NEAR(m.anchors[0].position.y, m.skyline.summit, 0.02)
      << "the cone's top is the highest of the skyline";
  EXPECT_NEAR(m.anchors[0].distance_m, 40000.0, 450.0);
  // A plain that is bent convexly hides nothing of itself; only what lies behind the cone is
  // hidden.
  EXPECT_GT(m.visible_ground, 0.75);
  EXPECT_LT(m.visible_ground, 0.999);
  EXPECT_EQ(m.lower_edge.empty, 0.0);
  EXPECT_EQ(m.lower_edge.cut, 0.0);
  EXPECT_GT(m.flat, 0.5) << "most of it is plain";
  // Sector between the lower edge and the horizon, over the region.
  EXPECT_NEAR(m.area,
              0.5 * 0.7679 * (view.far_m * view.far_m - view.near_m * view.near_m) /
                  (ground.side_m * ground.side_m),
              1e-3);
}

TEST(ViewMeasures, WhatStandsBehindAWallIsHidden) {
  // A wall of 3000 m from west to east, a hill behind it.
  const CoarseGround ground = make_coarse_ground(
      test::synthetic_raster(60.0,
                             [](double e, double n) {
                               if (std::abs(n - 30.0) < 1.0) return 3500.0;
                               return 500.0 +
                                      std::max(0.0, 300.0 - 100.0 * std::hypot(e - 30.0, n - 34.0));
                             }),
      300.0);
  const ViewShape view = view_of(ground, 30.0, -10.0, 0.0, 56000.0);
  const Anchor hill{
      .position = test::position_km(30.0, 34.0), .altitude_m = 800.0, .stands_m = 300.0};
  const Anchor before{
      .position = test::position_km(30.0, 24.0), .altitude_m = 500.0, .stands_m = 0.0};
  const ViewMeasures m = measure_view(ground, view, {hill, before});
  EXPECT_EQ(m.anchors[0].seen, 0.0);
  EXPECT_EQ(m.anchors[1].seen, 1.0);
  EXPECT_LT(m.visible_ground, 0.75);
}

TEST(ViewMeasures, ACanyonIsSeenAlongAndHiddenAcross) {
  const CoarseGround ground = test::canyon_region();
  const Massifs massifs = find_massifs(ground);
  std::size_t k = 0;
  while (massifs.anchors[k].kind != AnchorKind::canyon) ++k;
  const ViewMeasures along =
      measure_view(ground, view_of(ground, 20.0, -14.0, 0.0, 44000.0), massifs.anchors);
  const ViewMeasures across =
      measure_view(ground, view_of(ground, -14.0, 18.0, 90.0, 44000.0), massifs.anchors);
  EXPECT_GT(along.anchors[k].seen, across.anchors[k].seen + 0.2);
  EXPECT_GT(along.anchors[k].along, 0.9);
  EXPECT_LT(across.anchors[k].along, 0.45);
}

TEST(ViewMeasures, ALowerEdgeThroughMountainsIsCut) {
  const CoarseGround ground = test::chain_region();
  // The chain lies 20 km before the horizon's middle, or the lower edge half way up its front, or
  // behind its crest, where no top is cut off.
  EXPECT_EQ(measure_view(ground, view_of(ground, 30.0, -8.0, 0.0, 56000.0), {}).lower_edge.cut,
            0.0);
  EXPECT_GT(measure_view(ground, view_of(ground, 30.0, 14.0, 0.0, 30000.0), {}).lower_edge.cut,
            0.3);
  EXPECT_EQ(measure_view(ground, view_of(ground, 30.0, 20.5, 0.0, 30000.0), {}).lower_edge.cut,
            0.0);
}

TEST(ViewMeasures, APlateauOnTheLowerEdgeIsNotCut) {
  // High above the gorges at its sides, but it does not rise into the picture: there is no mountain
  // whose foot is missing.
  const auto plateau = [](double e, double n) {
    const bool gorge = std::fmod(e, 10.0) < 1.5;
    return gorge ? 500.0
                 : 1900.0 + 20.0 * std::sin(n) + (n > 45.0 ? 600.0 * std::sin(0.5 * e) : 0.0);
  };
  const CoarseGround ground = make_coarse_ground(test::synthetic_raster(60.0, plateau), 300.0);
  const ViewShape view = view_of(ground, 30.0, 5.0, 0.0, 40000.0);
  const GroundCell* edge = ground.at(view.viewer + glm::dvec2(2000.0, view.near_m));
  ASSERT_TRUE(edge);
  EXPECT_GT(static_cast<double>(edge->above_m), 0.40 * ground.relief_m);
  EXPECT_LT(measure_view(ground, view, {}).lower_edge.cut, 0.05);
}

TEST(ViewMeasures, AHumpFallsOffAndHasNoPeaks) {
  // Heights from the top: .1 in the middle, lower by `falls` at the sides, with three peaks of a
  // deviation of `peaks`.
  const auto hump = [](double falls, double peaks) {
    std::vector<double> line;
    for (int i = 0; i < 150; ++i) {
      const double x = 2.0 * i / 149.0 - 1.0;
      line.push_back(0.1 + falls * x * x - std::sqrt(2.0) * peaks * std::cos(6.283185 * 1.5 * x));
    }
    return hump_of(line);
  };
  EXPECT_EQ(hump(0.0, 0.0), 0.0) << "level";
  EXPECT_EQ(hump(0.1, 0.0), 0.0) << "no farther down than the world goes";
  EXPECT_NEAR(hump(0.25, 0.0), 1.0, 0.01);
  EXPECT_NEAR(hump(0.25, 0.018), 0.5, 0.15);
  EXPECT_EQ(hump(0.25, 0.045), 0.0) << "mountains that stand apart";
  const CoarseGround chain = test::chain_region();
  EXPECT_EQ(measure_view(chain, view_of(chain, 30.0, -8.0, 0.0, 56000.0), {}).skyline.hump, 0.0);
}

TEST(ViewMeasures, TheEndOfTheDataShows) {
  const CoarseGround ground = test::chain_region();
  const ViewMeasures inside = measure_view(ground, view_of(ground, 30.0, -8.0, 0.0, 56000.0), {});
  const ViewMeasures corner = measure_view(ground, view_of(ground, 12.0, -8.0, 0.0, 56000.0), {});
  EXPECT_GT(corner.lower_edge.empty + corner.rim.near_share,
            inside.lower_edge.empty + inside.rim.near_share);
  EXPECT_LT(inside.lower_edge.empty, 0.01);
}

}  // namespace
}  // namespace belvedere
