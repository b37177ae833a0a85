#include "renderer/compose/view_candidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/math.h"
#include "base/parallel.h"
#include "renderer/compose/view_measures.h"
#include "tests/renderer/compose/synthetic_region.h"

namespace belvedere {
namespace {

TEST(ViewCandidates, AnchorsLieWhereThePlanPutsThem) {
  const CoarseGround ground = test::chain_region();
  const Massifs massifs = find_massifs(ground);
  for (const double aspect : {2.0, 5.0})
    for (const double across : {0.35, 0.5, 0.65}) {
      const ViewSearch search{ground, massifs, {.format = {.aspect = aspect}}};
      const ViewPlan plan{.anchor = 0,
                          .azimuth_deg = 20.0,
                          .field_of_view_deg = 50.0,
                          .far_m = 30000.0,
                          .anchor_share = 0.7,
                          .across = across};
      const ViewShape view = shape_of(search, plan);
      const glm::dvec2 away = massifs.main().position - view.viewer;
      EXPECT_NEAR(glm::length(away), 21000.0, 1e-6);
      const glm::dvec2 direction = to_map(away / glm::length(away), -view.azimuth_deg);
      EXPECT_NEAR(ComposedPicture(view).position(direction, 0.0).x, across, 1e-9);
    }
}

TEST(ViewCandidates, EachFitsTheDataAndTheWishes) {
  const CoarseGround ground = test::chain_region();
  const Massifs massifs = find_massifs(ground);
  const ViewSearch search{ground, massifs, {.towards_deg = 350.0}};
  const std::vector<Candidate> candidates = first_candidates(search);
  ASSERT_FALSE(candidates.empty());
  for (const Candidate& c : candidates) {
    EXPECT_TRUE(fits_data(ground, c.view));
    EXPECT_LE(std::abs(std::remainder(c.view.azimuth_deg - 350.0, 360.0)), 15.0);
    EXPECT_LT(c.measures.lower_edge.empty, 0.2);
  }
}

TEST(ViewCandidates, RefiningNeverMakesWorse) {
  const CoarseGround ground = test::chain_region();
  const Massifs massifs = find_massifs(ground);
  const ViewSearch search{ground, massifs, {}};
  std::vector<Candidate> candidates = first_candidates(search);
  ASSERT_GT(candidates.size(), 20U);
  double gained = 0.0;
  for (std::size_t i = 0; i < candidates.size(); i += candidates.size() / 7) {
    const double before = judge(search, candidates[i].plan)->score;
    const Candidate after = refine(search, candidates[i]);
    EXPECT_GE(after.score, before);
    EXPECT_TRUE(fits_data(ground, after.view));
    gained += after.score - before;
  }
  EXPECT_GT(gained, 1.0);
}

TEST(ViewCandidates, TheSameForAnyThreads) {
  const CoarseGround ground = test::coast_region();
  const Massifs massifs = find_massifs(ground);
  const ViewSearch search{ground, massifs, {}};
  const auto scores = [&](int threads) {
    const ThreadLimit limit(threads);
    std::vector<double> out;
    for (const Candidate& c : first_candidates(search)) out.push_back(c.score);
    return out;
  };
  EXPECT_EQ(scores(1), scores(3));
}

TEST(ViewCandidates, AViewerStandsWhereItIsWished) {
  const CoarseGround ground = test::chain_region();
  const Massifs massifs = find_massifs(ground);
  const glm::dvec2 from = test::position_km(30.0, 2.0);
  const std::vector<Candidate> candidates = first_candidates({ground, massifs, {.from = from}});
  ASSERT_FALSE(candidates.empty());
  for (const Candidate& c : candidates) EXPECT_EQ(c.view.viewer, from);
}

using test::depression;

// From the south of the region northwards.
ViewShape northward(double aspect = 2.0, bool cylinder = false, double field_deg = 44.0) {
  ViewShape view{.viewer = test::position_km(30.0, -8.0),
                 .field_of_view_deg = field_deg,
                 .aspect = aspect,
                 .cylinder = cylinder,
                 .far_m = 52000.0};
  view.near_m = 0.42 * view.far_m;
  view.crest_m = 0.8 * view.far_m;
  return view;
}

struct Format {
  const char* name;
  double aspect;
  bool cylinder;
  double field_deg;
};
class Layout : public testing::TestWithParam<Format> {
 protected:
  ViewShape shape() const {
    return northward(GetParam().aspect, GetParam().cylinder, GetParam().field_deg);
  }
};

TEST_P(Layout, LevelGroundAtNearLiesOnTheLowerEdge) {
  const std::optional<ViewShape> view = lay_out(test::chain_region(), shape(), 0.0);
  ASSERT_TRUE(view);
  EXPECT_NEAR(ComposedPicture(*view).position({0.0, 1.0}, depression(*view, view->near_m)).y, 1.0,
              1e-6);
}

TEST_P(Layout, BentLevelGroundTouchesTheLineOfSightAtTheHorizon) {
  const std::optional<ViewShape> view = lay_out(test::chain_region(), shape(), 0.0);
  ASSERT_TRUE(view);
  const double at_far = depression(*view, view->far_m);
  EXPECT_GT(depression(*view, 0.99 * view->far_m), at_far);
  EXPECT_GT(depression(*view, 1.01 * view->far_m), at_far);
  EXPECT_NEAR((depression(*view, view->far_m + 1.0) - depression(*view, view->far_m - 1.0)) / 2.0,
              0.0, 1e-9)
      << "tangent";
}

TEST_P(Layout, TheSkyHasItsShare) {
  const CoarseGround ground = test::chain_region();
  const LayoutParameters parameters;
  const std::optional<ViewShape> view = lay_out(ground, shape(), 0.0, parameters);
  ASSERT_TRUE(view);
  const ViewMeasures m = measure_view(ground, *view, {});
  // Either most of the skyline or the highest summit is where it should be, by the samples of
  // another fan.
  const double over_summit = m.skyline.summit - parameters.over_summit;
  EXPECT_GT(over_summit, -0.012);
  EXPECT_GT(m.skyline.median, parameters.sky - 0.012);
  EXPECT_LT(std::min(over_summit, m.skyline.median - 0.02 - parameters.sky), 0.012);
}

INSTANTIATE_TEST_SUITE_P(Formats, Layout,
                         testing::Values(Format{"square", 1.0, false, 34.0},
                                         Format{"usual", 2.0, false, 44.0},
                                         Format{"wide", 3.0, false, 52.0},
                                         Format{"strip", 5.0, true, 65.0}),
                         [](const auto& p) { return p.param.name; });

TEST(Layout, WedgesOutsideOfTheDataDoNotFit) {
  const CoarseGround ground = test::chain_region();
  EXPECT_TRUE(fits_data(ground, northward()));
  ViewShape off = northward();
  off.viewer = test::position_km(5.0, -8.0);
  EXPECT_FALSE(fits_data(ground, off)) << "the left of it lies west of the data";
  ViewShape beyond = northward();
  beyond.far_m = 90000.0;
  beyond.near_m = 0.42 * beyond.far_m;
  EXPECT_FALSE(fits_data(ground, beyond));
  EXPECT_FALSE(lay_out(
      ground,
      [] {
        ViewShape nowhere = northward();
        nowhere.viewer = test::position_km(500.0, 0.0);
        return nowhere;
      }(),
      0.0));
}

TEST(Layout, FlatterLandIsExaggeratedMore) {
  const auto region = [](double height) {
    return make_coarse_ground(
        test::synthetic_raster(
            60.0, [&](double e, double n) { return 600.0 + height * (test::chain(e, n) - 600.0); }),
        300.0);
  };
  const auto steep = lay_out(region(1.0), northward(), 0.0);
  const auto flat = lay_out(region(0.3), northward(), 0.0);
  ASSERT_TRUE(steep && flat);
  EXPECT_GT(flat->exaggeration, steep->exaggeration);
  EXPECT_LE(flat->exaggeration, 2.0);
  EXPECT_GE(steep->exaggeration, 1.2);
}

// Level ground of 400 m, 60 km a side, seen northwards from its southern edge.
class Reach : public testing::Test {
 protected:
  ViewReach of(double eye_m, const DeformParameters& deform) {
    const CameraParameters camera{.projection = projection_,
                                  .width = 800,
                                  .height = 400,
                                  .eye = {viewer_, eye_m},
                                  .pitch_deg = -20.0,
                                  .field_of_view_deg = 44.0};
    return find_reach(ground_, Deformation(deform, viewer_), camera);
  }
  CoarseGround ground_ =
      make_coarse_ground(test::synthetic_raster(60.0, [](double, double) { return 400.0; }), 300.0);
  glm::dvec2 viewer_ = test::position_km(30.0, 0.0);
  std::string projection_ = "perspective";
};

// d = √(c² + 2 R h) is where the line of sight touches a bent plain, h the eye over it.
TEST_F(Reach, EndsWhereBentGroundIsHighestInThePicture) {
  const double eye_m = 5400.0, radius_m = 90000.0, crest_m = 30000.0;
  DeformParameters deform;
  deform.bend = {.radius_m = radius_m, .crest_m = crest_m};
  const ViewReach reach = of(eye_m, deform);
  const double horizon = std::sqrt(crest_m * crest_m + 2.0 * radius_m * (eye_m - 400.0));
  EXPECT_NEAR(reach.far_m, horizon, 1.0);
  // The lower edge: half of 2 atan(tan 22° / 2) below the pitch.
  const double edge = std::tan((20.0 * 3.14159265358979 / 180.0) +
                               std::atan(std::tan(22.0 * 3.14159265358979 / 180.0) / 2.0));
  const auto depression = [&](double d) {
    return (eye_m - 400.0 + (d - crest_m) * (d - crest_m) / (2.0 * radius_m)) / d;
  };
  EXPECT_NEAR(depression(reach.near_m), edge, 0.03);
}

TEST_F(Reach, GoesByTheGroundAsItIsRaised) {
  DeformParameters deform;
  deform.exaggeration = 2.0;
  deform.exaggeration_base_m = 0.0;
  deform.bend = {.radius_m = 90000.0, .crest_m = 30000.0};
  EXPECT_NEAR(of(5400.0, deform).far_m, std::sqrt(9e8 + 2.0 * 90000.0 * 4600.0), 1.0);
}

TEST_F(Reach, OfAPlainEndsWithTheData) {
  EXPECT_NEAR(of(5400.0, {}).far_m, 60000.0, 1500.0);
  projection_ = "oblique";
  EXPECT_NEAR(of(5400.0, {}).far_m, 60000.0, 1500.0);
  viewer_ = test::position_km(30.0, 100.0);
  EXPECT_EQ(of(5400.0, {}).far_m, 0.0) << "no data lie in the north";
}

}  // namespace
}  // namespace belvedere
