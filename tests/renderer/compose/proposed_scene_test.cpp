#include "renderer/compose/proposed_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/progress.h"
#include "renderer/compose/view_changes.h"
#include "renderer/scene/scene_file.h"
#include "renderer/world/view.h"
#include "tests/files.h"
#include "tests/renderer/compose/synthetic_region.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

class ProposedScenes : public testing::Test {
 protected:
  ProposedScenes() {
    about_.title = "A \"chain\"";
    about_.sources.push_back({"chain.tif", "", {}});
    about_.crs = "EPSG:32632";
    best_ = propose_views(search_, {.max = 1}).front();
  }
  LoadedScene parsed() const {
    return parse_scene(proposed_scene_text(search_, best_, about_), "chain.toml", folder_.path(),
                       {});
  }

  test::Folder folder_;
  CoarseGround ground_ = test::chain_region();
  Massifs massifs_ = find_massifs(ground_);
  ViewSearch search_{ground_, massifs_, {}};
  Candidate best_;
  ProposedScene about_;
};

TEST_F(ProposedScenes, ReadsBackAsTheViewThatWasFound) {
  const Scene scene = parsed().scene;
  const ViewShape& view = best_.view;
  EXPECT_EQ(scene.title, "A \"chain\"");
  EXPECT_EQ(scene.terrain.dem.crs, "EPSG:32632");
  ASSERT_TRUE(scene.camera.position);
  EXPECT_NEAR(scene.camera.position->x, view.viewer.x, 0.5);
  EXPECT_NEAR(scene.camera.height_m.value(), view.eye_m, 0.5);
  EXPECT_NEAR(scene.camera.pitch_deg.value(), view.pitch_deg, 0.005);
  EXPECT_NEAR(scene.deform.bend_radius_m.value(), view.radius_m, 0.001 * view.radius_m);
  EXPECT_NEAR(scene.deform.bend_crest_m.value(), view.crest_m, 0.001 * view.crest_m);
  EXPECT_NEAR(scene.deform.exaggeration.value(), view.exaggeration, 0.005);
  EXPECT_EQ(scene.output.width, 2400);
  EXPECT_EQ(scene.output.height, 1200);
}

// The measures on the coarse ground match the renderer's view.
TEST_F(ProposedScenes, TheRenderersViewPutsTheMainSummitWhereItWasFound) {
  best_ = judge(search_, best_.plan).value();  // without changes to the land
  const Scene scene = parsed().scene;
  const Dem dem = make_dem(test::synthetic_raster(60.0, test::chain));
  const View view = make_view(scene, dem, silent_progress());
  DeformParameters deform = view.deform;
  deform.summits.clear();  // raised by the scene, on top of what was measured
  const Anchor& main = massifs_.anchors[static_cast<std::size_t>(best_.plan.anchor)];
  const glm::dvec3 position =
      Deformation(deform, view.viewer_xy).point({main.position, main.altitude_m});
  const auto at = make_camera(view.camera)->project(position);
  ASSERT_TRUE(at);
  const AnchorSight& sight = best_.measures.anchors[static_cast<std::size_t>(best_.plan.anchor)];
  EXPECT_NEAR(at->x / scene.output.width, sight.position.x, 0.003);
  EXPECT_NEAR(at->y / scene.output.height, sight.position.y, 0.004);
}

TEST_F(ProposedScenes, SaysWhyAndWhatElseWasAsked) {
  about_.palette = "desert";
  about_.palette_why = "dry";
  about_.land_cover = ProposedFile{.file = "cover.tif"};
  about_.legend = "nlcd";
  about_.rock = "sandstone";
  about_.style = "gogh";
  about_.sources[0].lowest_m = -5.0;
  about_.sources[0].encoding = "mapbox";
  about_.land_cover->variable = "classes";
  const std::string text = proposed_scene_text(search_, best_, about_);
  EXPECT_THAT(text, HasSubstr("palette = \"desert\""));
  EXPECT_THAT(text, HasSubstr("legend = \"nlcd\""));
  EXPECT_THAT(text, HasSubstr("lowest_m = -5"));
  EXPECT_THAT(text, HasSubstr("% of the picture is sky"));
  EXPECT_EQ(parsed().scene.land_cover.legend, "nlcd");
  EXPECT_EQ(parsed().scene.terrain.sources[0].raster.encoding, "mapbox");
  EXPECT_EQ(parsed().scene.land_cover.sources[0].raster.variable, "classes");
  EXPECT_EQ(parsed().scene.land_cover.rock, "sandstone");
  EXPECT_EQ(parsed().scene.style.file, "gogh");
}

TEST_F(ProposedScenes, SaysWhatIsDoneToTheLandAndWhatItWins) {
  const int main = best_.plan.anchor;
  const int other = main == 0 ? 1 : 0;
  best_.changes = {};
  ASSERT_EQ(parsed().scene.deform.summits.size(), 1U) << "the main summit leads";
  EXPECT_NEAR(parsed().scene.deform.summits[0].summit.factor, 1.15, 0.01);
  EXPECT_EQ(parsed().scene.generalize.valleys.width_m, 0.F);
  best_.changes.widen_valleys_m = 450.0;
  best_.changes.widened.words = "floor 19 to 59 %";
  const Anchor& summit = massifs_.anchors[static_cast<std::size_t>(other)];
  best_.changes.summits.push_back({.anchor = other,
                                   .by = raise_of(summit, best_.view, 1.3),
                                   .gain = {0.2, "tops 70 to 100 %"}});
  const Scene scene = parsed().scene;
  EXPECT_EQ(scene.generalize.valleys.width_m, 450.F);
  ASSERT_EQ(scene.deform.summits.size(), 2U);
  EXPECT_NEAR(scene.deform.summits[0].summit.factor, 1.3, 1e-9);
  EXPECT_NEAR(scene.deform.summits[0].position->x, summit.position.x, 0.51);
  EXPECT_THAT(proposed_scene_text(search_, best_, about_),
              testing::AllOf(HasSubstr("floor 19 to 59 %"), HasSubstr("tops 70 to 100 %")));
  best_.changes.summits[0].anchor = main;
  EXPECT_EQ(parsed().scene.deform.summits.size(), 1U) << "the main summit is raised once";
}

TEST_F(ProposedScenes, WideOnesAreCylinders) {
  const ViewSearch wide{ground_, massifs_, {.format = {.aspect = 10.0, .full_turn = true}}};
  best_ = propose_views(wide, {.max = 1}).front();
  const Scene scene =
      parse_scene(proposed_scene_text(wide, best_, about_), "chain.toml", folder_.path(), {}).scene;
  EXPECT_EQ(scene.camera.projection, "cylindrical");
  EXPECT_EQ(scene.camera.field_of_view_deg, 360.0);
  EXPECT_EQ(scene.output.height, 240);
}

using testing::AllOf;

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
    return test::input_error([&] { require_region(ground, find_massifs(ground), "my.tif"); });
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
  EXPECT_THAT(test::input_error([&] { propose_views(search); }),
              AllOf(HasSubstr("no view from there"), HasSubstr("--from")));
}

}  // namespace
}  // namespace belvedere
