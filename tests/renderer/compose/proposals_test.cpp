#include "renderer/compose/proposals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "tests/files.h"
#include "tests/renderer/compose/synthetic_region.h"

namespace belvedere {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Proposals, AreTheBestThatDiffer) {
  const CoarseGround ground = test::chain_region();
  const Massifs massifs = find_massifs(ground);
  const ViewSearch search{ground, massifs, {}};
  const std::vector<Candidate> proposals = propose_views(search, {.max = 5});
  ASSERT_GE(proposals.size(), 3U);
  for (std::size_t i = 0; i < proposals.size(); ++i) {
    if (i > 0) {
      EXPECT_GE(proposals[i - 1].score, proposals[i].score);
    }
    EXPECT_LT(proposals[i].measures.lower_edge.cut, 0.1);
    EXPECT_NEAR(proposals[i].measures.skyline.mean, 0.15, 0.06);
    for (std::size_t j = 0; j < i; ++j) {
      const double turn = std::abs(
          std::remainder(proposals[i].view.azimuth_deg - proposals[j].view.azimuth_deg, 360.0));
      EXPECT_TRUE(turn > 25.0 || proposals[i].plan.anchor != proposals[j].plan.anchor);
    }
  }
}

TEST(Proposals, FromOnePlaceViewsDifferByTheirDirection) {
  const CoarseGround ground = test::chain_region();
  const Massifs massifs = find_massifs(ground);
  const std::vector<Candidate> proposals =
      propose_views({ground, massifs, {.from = test::position_km(30.0, 3.0)}});
  ASSERT_FALSE(proposals.empty());
  for (std::size_t i = 0; i < proposals.size(); ++i) {
    EXPECT_TRUE(
        proposals[i].measures.anchors[static_cast<std::size_t>(proposals[i].plan.anchor)].inside)
        << "what it is about is in it";
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(std::abs(std::remainder(
                    proposals[i].view.azimuth_deg - proposals[j].view.azimuth_deg, 360.0)),
                25.0);
  }
}

TEST(Proposals, ALoneMountainIsTheSubject) {
  const CoarseGround ground = test::cone_region();
  const Massifs massifs = find_massifs(ground);
  const Candidate best = propose_views({ground, massifs, {}}).front();
  EXPECT_EQ(best.plan.anchor, 0);
  EXPECT_TRUE(best.measures.anchors[0].inside);
  EXPECT_EQ(best.measures.anchors[0].seen, 1.0);
}

TEST(Proposals, APlateausCanyonIsTheSubjectAndSeenAlong) {
  const CoarseGround ground = test::canyon_region();
  const Massifs massifs = find_massifs(ground);
  const Candidate best = propose_views({ground, massifs, {}}).front();
  const Anchor& anchor = massifs.anchors[static_cast<std::size_t>(best.plan.anchor)];
  EXPECT_EQ(anchor.kind, AnchorKind::canyon);
  EXPECT_GT(best.measures.anchors[static_cast<std::size_t>(best.plan.anchor)].along, 0.8);
}

TEST(Proposals, WishesHold) {
  const CoarseGround ground = test::chain_region();
  const Massifs massifs = find_massifs(ground);
  const glm::dvec2 wanted = test::position_km(18.0, 22.0);
  const ViewSearch search{ground, massifs, {.towards_deg = 0.0, .include = {{"the hut", wanted}}}};
  for (const Candidate& c : propose_views(search)) {
    EXPECT_LE(std::abs(std::remainder(c.view.azimuth_deg, 360.0)), 15.0 + 1e-6);
    EXPECT_TRUE(c.measures.anchors.back().inside);
  }
}

TEST(Proposals, AllFormatsHaveViews) {
  const CoarseGround ground = test::chain_region();
  const Massifs massifs = find_massifs(ground);
  for (const ViewFormat format :
       {ViewFormat{1.0, false}, ViewFormat{1.414, false}, ViewFormat{3.0, false},
        ViewFormat{5.0, false}, ViewFormat{10.0, true}}) {
    const std::vector<Candidate> proposals =
        propose_views({ground, massifs, {.format = format}}, {.max = 1});
    ASSERT_EQ(proposals.size(), 1U);
    EXPECT_EQ(proposals[0].view.cylinder, format.aspect > 3.2 || format.full_turn);
    // With a full circle, low land on one side leaves more sky than a chosen direction.
    EXPECT_NEAR(proposals[0].measures.skyline.mean, 0.15, format.full_turn ? 0.13 : 0.08)
        << format.aspect;
    EXPECT_LT(proposals[0].measures.lower_edge.empty, 0.02) << format.aspect;
  }
}

TEST(Proposals, RegionsThatCannotMakeAPictureAreRefusedWithAWayOut) {
  const auto refused = [](const CoarseGround& ground) {
    return test::message_of(ErrorKind::input,
                            [&] { require_region(ground, find_massifs(ground), "my.tif"); });
  };
  EXPECT_THAT(
      refused(make_coarse_ground(
          test::synthetic_raster(5.0, [](double e, double n) { return 100.0 * (e + std::sin(n)); }),
          25.0)),
      AllOf(HasSubstr("my.tif"), HasSubstr("25 km²"), HasSubstr("8 km")));
  EXPECT_THAT(
      refused(make_coarse_ground(
          test::synthetic_raster(
              60.0, [](double e, double n) { return e < 40.0 ? NAN : 500.0 + test::chain(e, n); }),
          300.0)),
      HasSubstr("no data"));
  EXPECT_THAT(refused(make_coarse_ground(
                  test::synthetic_raster(60.0, [](double e, double) { return 100.0 + e; }), 300.0)),
              HasSubstr("flat"));
  const CoarseGround good = test::chain_region();
  EXPECT_NO_THROW(require_region(good, find_massifs(good), "my.tif"));
}

TEST(Proposals, NoViewThatFitsIsSaid) {
  const CoarseGround ground = test::chain_region();
  const Massifs massifs = find_massifs(ground);
  const ViewSearch search{
      ground, massifs, {.towards_deg = 180.0, .from = test::position_km(30.0, -1.0)}};
  EXPECT_THAT(test::message_of(ErrorKind::input, [&] { propose_views(search); }),
              AllOf(HasSubstr("no view from there"), HasSubstr("--from")));
}

}  // namespace
}  // namespace belvedere
