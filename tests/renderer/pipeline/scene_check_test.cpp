#include "renderer/pipeline/scene_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.h"
#include "base/text/embedded.h"
#include "renderer/compose/proposed_scene.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/scene/scene_file.h"
#include "terrain/io/raster_io.h"
#include "terrain/synthetic/synthetic.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/renderer/compose/synthetic_region.h"
#include "tests/renderer/pipeline/painted_scene.h"

namespace belvedere {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

TEST(SceneCheck, SaysWhatIsKnownBeforeTheWork) {
  const SceneReport report =
      check_scene(test::small_scene({"synthesis.enabled=false"}), silent_progress());
  EXPECT_EQ(report.crs, "none");
  EXPECT_EQ(report.cells_wide, 120);
  EXPECT_EQ(report.cells_high, 120);
  EXPECT_EQ(report.cell_m, 100.0);
  EXPECT_EQ(report.view.camera.eye, glm::dvec3(6000.0, -4000.0, 6000.0));
  EXPECT_THAT(report.inputs, IsEmpty());
  EXPECT_THAT(report.exemplars, IsEmpty());
  double shares = 0.0;
  for (const auto& [id, share] : report.classes) {
    EXPECT_GT(share, 0.0) << class_name(id);
    shares += share;
  }
  EXPECT_NEAR(shares, 1.0, 1e-9);
  EXPECT_EQ(report.classes.front().first, LandCoverClass::sky) << "in the order of the classes";
}

TEST(SceneCheck, SaysWhatThePictureTakesOfTerrainLargerThanMemory) {
  test::Folder folder;
  Raster<float> raster{
      Grid<float>(600, 600), {600000.0, 5200000.0, 30.0, 30.0}, normalize_crs("EPSG:32632")};
  for (const auto [x, y] : test::cells(600, 600))
    raster.cells(x, y) = 900.F + static_cast<float>(x + y);
  write_raster(folder / "terrain.tif", raster);
  const auto check = [&](const char* max) {
    return check_scene(
        parse_scene("version = 1\n[[terrain.sources]]\nfile = \"terrain.tif\"\n[camera]\nposition "
                    "= [609000, 5181000]\n"
                    "height_m = 4000\npitch_deg = -14\n[synthesis]\nenabled = "
                    "false\n[output]\nwidth = 100\nheight = 80\n",
                    "big.toml", folder / "", {.data_folders = {folder / ""}, .settings = {max}}),
        silent_progress());
  };
  const SceneReport report = check("terrain.max_mcells=0.25");
  EXPECT_THAT(report.larger_than_memory,
              HasSubstr("600 × 600 cells is more than memory holds: read at"));
  EXPECT_GT(report.cell_m, 30.0) << "looked at";
  EXPECT_LT(report.cells_wide, 600);
  EXPECT_EQ(check("terrain.max_mcells=1").larger_than_memory, "");
}

class PaintedSceneCheck : public testing::Test {
 protected:
  // Both refuse the scene in the same words, and nothing is written.
  std::string refused(ErrorKind kind, const LoadedScene& scene) const {
    const std::string check =
        test::message_of(kind, [&] { check_scene(scene, silent_progress()); });
    const std::string render_message =
        test::message_of(kind, [&] { render(scene, folder_ / "out", {}); });
    EXPECT_EQ(check, render_message);
    EXPECT_FALSE(fs::exists(folder_ / "out"));
    return check;
  }
  test::Folder folder_;
};

TEST_F(PaintedSceneCheck, RefusesWhatRenderingRefuses) {
  test::write_painting(folder_);
  fs::resize_file(folder_ / "red.png", fs::file_size(folder_ / "red.png") / 2);
  EXPECT_THAT(refused(ErrorKind::input, test::painted_scene(folder_)), HasSubstr("red.png"));
  EXPECT_THAT(refused(ErrorKind::input, test::painted_scene(folder_, {"synthesis.colours=painting",
                                                                      "synthesis.enabled=false"})),
              HasSubstr("red.png"));
  fs::remove(folder_ / "red.png");
  EXPECT_THAT(refused(ErrorKind::input, test::painted_scene(folder_)),
              HasSubstr("exemplar.0.picture"));
  folder_.write("printer.icc", "no profile");
  EXPECT_THAT(
      refused(ErrorKind::input, test::small_scene({"output.profile=printer.icc"}, folder_.path())),
      HasSubstr("printer.icc"));
}

TEST_F(PaintedSceneCheck, AClassOfThePictureNeedsTexelsOrAFallback) {
  test::write_painting(folder_);
  const SceneReport whole = check_scene(test::painted_scene(folder_), silent_progress());
  EXPECT_THAT(whole.exemplars, SizeIs(1));
  ASSERT_THAT(whole.exemplar_classes, SizeIs(1));
  for (const auto& [id, share] : whole.classes) {  // the painting has all classes of the ground
    if (id == LandCoverClass::sky) continue;
    EXPECT_THAT(whole.exemplar_classes[0], testing::Contains(id));
  }
  EXPECT_THAT(whole.inputs, SizeIs(2));
  // Water (1) and fields only: other classes of the hills must not be painted.
  test::write_painting(folder_, 2);
  const std::string message =
      test::usage_error([&] { check_scene(test::painted_scene(folder_), silent_progress()); });
  EXPECT_THAT(message, AllOf(HasSubstr("small"), HasSubstr("forest"), HasSubstr("fallback"),
                             Not(HasSubstr("sky"))));
}

TEST_F(PaintedSceneCheck, AViewStandsForThePixelsOfItsPicture) {
  test::write_painting(folder_);
  const SceneExemplars looked = look_at_exemplars(
      test::painted_scene(folder_, {"output.width=960", "output.height=800"}), silent_progress());
  EXPECT_EQ(looked.view.width(), 480);
  EXPECT_EQ(looked.view.height(), 400);
  EXPECT_EQ(looked.pixels_of_picture, 4.0);
  EXPECT_THAT(looked.exemplars, SizeIs(1));
}

class ViewJudgementTest : public testing::Test {
 protected:
  ViewEvaluation judge(const std::vector<std::string>& settings = {}) const {
    ProposedScene about;
    about.sources.push_back({"chain.tif", "", {}});
    about.crs = "EPSG:32632";
    const Scene scene = parse_scene(proposed_scene_text(search_, best_, about), "chain.toml", ".",
                                    {.data_folders = {}, .settings = settings})
                            .scene;
    return evaluate_view(coarse_altitudes_of(dem_), make_view(scene, dem_, silent_progress()));
  }
  static const ScoreTerm& term(const ViewEvaluation& evaluation, std::string_view name) {
    for (const ScoreTerm& t : evaluation.terms)
      if (t.name == name) return t;
    throw std::runtime_error("no such term");
  }

  Dem dem_ = make_dem(test::synthetic_raster(60.0, test::chain));
  CoarseGround ground_ = test::chain_region();
  Massifs massifs_ = find_massifs(ground_);
  ViewSearch search_{ground_, massifs_, {}};
  Candidate best_ = propose_views(search_, {.max = 1}).front();
};

// Read from the scene, by another camera, the measures match those of the proposal.
TEST_F(ViewJudgementTest, OfAProposalIsTheProposals) {
  const ViewEvaluation evaluation = judge({"deform.summits=[]"});
  ASSERT_TRUE(evaluation.evaluated());
  EXPECT_NEAR(evaluation.near_m / best_.view.near_m, 1.0, 0.06);
  EXPECT_NEAR(evaluation.far_m / best_.view.far_m, 1.0, 0.06);
  EXPECT_NEAR(evaluation.merit, best_.merit, 0.8);
  for (const ScoreTerm& mine : best_.terms) {
    const double there = term(evaluation, mine.name).value;
    const double tolerance = mine.unit == TermUnit::share     ? 0.06
                             : mine.unit == TermUnit::degrees ? 3.0
                                                              : 0.25 * std::max(1.0, mine.value);
    EXPECT_NEAR(there, mine.value, tolerance) << mine.name;
  }
}

TEST_F(ViewJudgementTest, SaysWhatIsWrong) {
  const ViewEvaluation raised = judge({"camera.tilt_deg=8"});
  EXPECT_GT(term(raised, "sky").value, term(judge(), "sky").value + 0.15);
  EXPECT_THAT(std::string(term(raised, "sky").advice()), HasSubstr("much sky"));
  EXPECT_LT(raised.merit, judge().merit - 0.5);
  const ViewEvaluation fog = judge({"air.from_m=0", "air.scale_m=2000", "air.haze=1"});
  EXPECT_THAT(std::string(term(fog, "haze").advice()), HasSubstr("too much haze"));
  const ViewEvaluation away =
      judge({"camera.azimuth_deg=" +
             std::to_string(static_cast<int>(best_.view.azimuth_deg + 180.0) % 360)});
  EXPECT_TRUE(!away.evaluated() || away.merit < 4.0);
}

TEST_F(ViewJudgementTest, RaisedSummitsCount) {
  const glm::dvec2 position =
      massifs_.anchors[static_cast<std::size_t>(best_.plan.anchor)].position;
  const std::string at = std::to_string(position.x) + ", " + std::to_string(position.y);
  const ViewEvaluation plain = judge({"deform.summits=[]"});
  const ViewEvaluation raised = judge({"deform.summits=[{ position = [" + at +
                                       "], radius_m = 8000, factor = 1.8, base_m = 500 }]"});
  EXPECT_GT(term(raised, "sky").value, 0.0);
  EXPECT_NE(term(raised, "sky").value, term(plain, "sky").value);
}

TEST_F(ViewJudgementTest, ParallelProjectionsAreNotJudged) {
  const ViewEvaluation evaluation = judge({"camera.projection=oblique", "camera.pitch_deg=-30"});
  EXPECT_FALSE(evaluation.evaluated());
  EXPECT_THAT(evaluation.why_not, HasSubstr("parallel"));
}

// The first view of a new user. Where the demo's data ended below its horizon, far ranges were
// single cones in front of nothing: the end of the data was 3 % of the picture, ranges were 2.5
// deep, and the skyline fell off to its corners.
TEST(DemoViewLong, HasRangesUpToItsHorizonAndNoEndOfTheData) {
  const Scene scene =
      parse_scene(std::string(embedded_file("scenes/demo/demo.toml")), "demo.toml", ".", {}).scene;
  ASSERT_TRUE(scene.terrain.synthetic.has_value());
  const Dem dem = make_synthetic_terrain(*scene.terrain.synthetic, silent_progress());
  const ViewEvaluation evaluation =
      evaluate_view(coarse_altitudes_of(dem), make_view(scene, dem, silent_progress()));
  ASSERT_TRUE(evaluation.evaluated()) << evaluation.why_not;
  const auto value = [&](std::string_view name) {
    const auto found = std::find_if(evaluation.terms.begin(), evaluation.terms.end(),
                                    [&](const ScoreTerm& t) { return t.name == name; });
    return found == evaluation.terms.end() ? -1.0 : found->value;
  };
  EXPECT_LE(value("rim"), 0.012);
  EXPECT_GE(value("ranges"), 3.1);
  EXPECT_LE(value("level"), 0.235);
  EXPECT_GE(evaluation.merit, 7.0);
}

}  // namespace
}  // namespace belvedere
