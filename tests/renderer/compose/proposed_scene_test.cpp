#include "renderer/compose/proposed_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/progress.h"
#include "renderer/compose/proposals.h"
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
      deform_point({main.position, main.altitude_m}, view.viewer_xy, deform);
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

}  // namespace
}  // namespace belvedere
