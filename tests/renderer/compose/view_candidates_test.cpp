#include "renderer/compose/view_candidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/parallel.h"
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

}  // namespace
}  // namespace belvedere
