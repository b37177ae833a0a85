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
#include "tests/renderer/compose/made_up_region.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

class ViewJudgementTest : public testing::Test {
 protected:
  ViewJudgement judge(const std::vector<std::string>& settings = {}) const {
    ProposedScene about;
    about.sources.push_back({"chain.tif", "", {}});
    about.crs = "EPSG:32632";
    const Scene scene =
        parse_scene(proposed_scene_text(search_, best_, about), "chain.toml", ".", {.data_folders = {}, .settings = settings}).scene;
    return judge_view(coarse_altitudes_of(dem_), make_view(scene, dem_, silent_progress()));
  }
  static const ScoreTerm& term(const ViewJudgement& judgement, std::string_view name) {
    for (const ScoreTerm& t : judgement.terms)
      if (t.name == name) return t;
    throw std::runtime_error("no such term");
  }

  Dem dem_ = make_dem(test::made_up_raster(60.0, test::chain));
  CoarseGround ground_ = test::chain_region();
  Massifs massifs_ = find_massifs(ground_);
  ViewSearch search_{ground_, massifs_, {}};
  Candidate best_ = propose_views(search_, {.most = 1}).front();
};

// Read from the scene, by another camera, the same measures come out that the proposal was chosen by.
TEST_F(ViewJudgementTest, OfAProposalIsTheProposals) {
  const ViewJudgement judgement = judge({"deform.summits=[]"});
  ASSERT_TRUE(judgement.judged());
  EXPECT_NEAR(judgement.near_m / best_.view.near_m, 1.0, 0.06);
  EXPECT_NEAR(judgement.far_m / best_.view.far_m, 1.0, 0.06);
  EXPECT_NEAR(judgement.merit, best_.merit, 0.8);
  for (const ScoreTerm& mine : best_.terms) {
    const double there = term(judgement, mine.name).value;
    const double tolerance = mine.unit == TermUnit::share ? 0.06 : mine.unit == TermUnit::degrees ? 3.0 : 0.25 * std::max(1.0, mine.value);
    EXPECT_NEAR(there, mine.value, tolerance) << mine.name;
  }
}

TEST_F(ViewJudgementTest, SaysWhatIsWrong) {
  const ViewJudgement raised = judge({"camera.tilt_deg=8"});
  EXPECT_GT(term(raised, "sky").value, term(judge(), "sky").value + 0.15);
  EXPECT_THAT(std::string(term(raised, "sky").advice()), HasSubstr("much sky"));
  EXPECT_LT(raised.merit, judge().merit - 0.5);
  const ViewJudgement fog = judge({"air.from_m=0", "air.scale_m=2000", "air.haze=1"});
  EXPECT_THAT(std::string(term(fog, "haze").advice()), HasSubstr("drowns in haze"));
  const ViewJudgement away = judge({"camera.azimuth_deg=" + std::to_string(static_cast<int>(best_.view.azimuth_deg + 180.0) % 360)});
  EXPECT_TRUE(!away.judged() || away.merit < 4.0);
}

TEST_F(ViewJudgementTest, RaisedSummitsCount) {
  const glm::dvec2 place = massifs_.anchors[static_cast<std::size_t>(best_.plan.anchor)].place;
  const std::string at = std::to_string(place.x) + ", " + std::to_string(place.y);
  const ViewJudgement plain = judge({"deform.summits=[]"});
  const ViewJudgement raised = judge({"deform.summits=[{ position = [" + at + "], radius_m = 8000, factor = 1.8, base_m = 500 }]"});
  EXPECT_GT(term(raised, "sky").value, 0.0);
  EXPECT_NE(term(raised, "sky").value, term(plain, "sky").value);
}

TEST_F(ViewJudgementTest, ParallelProjectionsAreNotJudged) {
  const ViewJudgement judgement = judge({"camera.projection=oblique", "camera.pitch_deg=-30"});
  EXPECT_FALSE(judgement.judged());
  EXPECT_THAT(judgement.why_not, HasSubstr("parallel"));
}

// What a new user sees first. Where the demo's data ended under its horizon, far ranges were single cones in front of nothing: the end of
// the data was 3 % of the picture, ranges stood 2.5 deep, and the skyline fell off to its corners.
TEST(DemoViewLong, HasRangesUpToItsHorizonAndNoEndOfTheData) {
  const Scene scene = parse_scene(std::string(embedded_file("scenes/demo/demo.toml")), "demo.toml", ".", {}).scene;
  ASSERT_TRUE(scene.terrain.synthetic.has_value());
  const Dem dem = make_synthetic_terrain(*scene.terrain.synthetic, silent_progress());
  const ViewJudgement judgement = judge_view(coarse_altitudes_of(dem), make_view(scene, dem, silent_progress()));
  ASSERT_TRUE(judgement.judged()) << judgement.why_not;
  const auto value = [&](std::string_view name) {
    const auto found = std::find_if(judgement.terms.begin(), judgement.terms.end(), [&](const ScoreTerm& t) { return t.name == name; });
    return found == judgement.terms.end() ? -1.0 : found->value;
  };
  EXPECT_LE(value("rim"), 0.012);
  EXPECT_GE(value("ranges"), 3.1);
  EXPECT_LE(value("level"), 0.235);
  EXPECT_GE(judgement.merit, 7.0);
}

}  // namespace
}  // namespace belvedere
