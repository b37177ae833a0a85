#include "renderer/pipeline/view_judgement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/progress.h"
#include "base/text/embedded.h"
#include "renderer/compose/proposals.h"
#include "renderer/compose/proposed_scene.h"
#include "renderer/scene/scene_file.h"
#include "terrain/synthetic/synthetic.h"
#include "tests/renderer/compose/synthetic_region.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

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
