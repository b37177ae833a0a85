#include "renderer/compose/view_score.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace belvedere {
namespace {

TEST(Plateau, RisesAndFalls) {
  const Plateau p{1.0, 2.0, 4.0, 8.0};
  EXPECT_EQ(plateau(1.0, p), 0.0);
  EXPECT_EQ(plateau(1.5, p), 0.5);
  EXPECT_EQ(plateau(2.0, p), 1.0);
  EXPECT_EQ(plateau(4.0, p), 1.0);
  EXPECT_EQ(plateau(6.0, p), 0.5);
  EXPECT_EQ(plateau(8.0, p), 0.0);
  EXPECT_EQ(plateau(-3.0, p), 0.0);
}

// A view that is good in all terms.
ViewMeasures good_measures() {
  ViewMeasures m;
  m.skyline.mean = 0.13, m.skyline.low = 0.17, m.skyline.median = 0.15, m.skyline.deviation = 0.04;
  m.visible_ground = 0.8, m.floor.visible = 1.0, m.floor.share = 0.05, m.floor.depth_spread = 1.0,
  m.floor.width_spread = 1.0, m.water = 0.05;
  m.ranges = 3.0, m.forms = 0.18, m.rise = 0.5, m.area = 0.6, m.lower_edge.angle_deg = 36.0,
  m.haze = 0.2, m.lower_edge.cell_px = 8.0;
  m.anchors = {{.inside = true,
                .seen = 1.0,
                .position = {0.35, 0.08},
                .size = 0.3,
                .along = 1.0,
                .distance_m = 30000.0}};
  return m;
}
ScoreContext context() {
  return {.lone = 0.0, .plateau = 0.0, .main = 0, .anchors = {{.rank = 1.0}}};
}

TEST(ViewScore, AGoodViewHasAll) {
  const std::vector<ScoreTerm> terms = score_terms(good_measures(), context());
  for (const ScoreTerm& term : terms) EXPECT_NEAR(term.points(), term.max(), 1e-9) << term.name;
  EXPECT_GT(merit(terms, context()), 9.0) << "a canyon could have a little more";
  EXPECT_LE(merit(terms, context()), 10.0);
}

TEST(ViewScore, EveryMeasureCounts) {
  const double best = total(score_terms(good_measures(), context()));
  const auto worse = [&](auto change) {
    ViewMeasures m = good_measures();
    change(m);
    return best - total(score_terms(m, context()));
  };
  EXPECT_NEAR(worse([](ViewMeasures& m) { m.skyline.mean = 0.40; }), 8.0 * 0.21, 1e-9);
  EXPECT_GT(worse([](ViewMeasures& m) { m.skyline.mean = 0.02; }), 0.5);
  EXPECT_GT(worse([](ViewMeasures& m) { m.lower_edge.cut = 0.30; }), 1.0);
  EXPECT_GT(worse([](ViewMeasures& m) { m.lower_edge.empty = 0.2; }), 1.0);
  EXPECT_GT(worse([](ViewMeasures& m) { m.anchors[0].seen = 0.0; }), 1.0);
  EXPECT_GT(worse([](ViewMeasures& m) { m.anchors[0].inside = false; }), 2.0);
  EXPECT_GT(worse([](ViewMeasures& m) { m.lower_edge.cell_px = 30.0; }), 1.0);
  EXPECT_GT(worse([](ViewMeasures& m) { m.forms = 0.05; }), 1.0);
  EXPECT_GT(worse([](ViewMeasures& m) { m.ranges = 0.5; }), 0.5);
  EXPECT_GT(worse([](ViewMeasures& m) { m.lower_edge.angle_deg = 60.0; }), 0.5);
  EXPECT_EQ(worse([](ViewMeasures& m) { m.haze = 0.9; }), 0.0)
      << "said, but follows from the layout in every proposal";
}

TEST(ViewScore, AdvisesWhereItIsNotGoodAlone) {
  const auto advice = [](const ViewMeasures& m, std::string_view name) {
    for (const ScoreTerm& term : score_terms(m, context()))
      if (term.name == name) return std::string(term.advice());
    return std::string("no such term");
  };
  for (const ScoreTerm& term : score_terms(good_measures(), context()))
    EXPECT_EQ(term.advice(), "") << term.name;
  ViewMeasures m = good_measures();
  m.skyline.mean = 0.3;
  m.haze = 0.9;
  m.anchors[0].along = 0.0;
  EXPECT_NE(advice(m, "sky").find("much sky"), std::string::npos);
  EXPECT_NE(advice(m, "haze").find("too much haze"), std::string::npos);
  EXPECT_EQ(advice(m, "along"), "") << "the subject is no canyon";
  m.skyline.mean = 0.05;
  EXPECT_NE(advice(m, "sky").find("little sky"), std::string::npos);
}

TEST(ViewScore, ValleysHiddenBehindRangesAreNoFaultAViewWithoutAnyIs) {
  const auto told = [](double floor_open) {
    ViewMeasures m = good_measures();
    m.floor.visible = floor_open;
    std::vector<std::string> out;
    for (const ScoreTerm& term : score_terms(m, context()))
      if (!term.advice().empty()) out.emplace_back(term.name);
    return out;
  };
  EXPECT_EQ(told(0.41), std::vector<std::string>{});
  EXPECT_EQ(told(0.10), std::vector<std::string>{"valley"});
  ViewMeasures fewer = good_measures();
  fewer.floor.visible = 0.41;
  EXPECT_LT(total(score_terms(fewer, context())), total(score_terms(good_measures(), context())))
      << "more is still better";
}

TEST(ViewScore, AMountainThatStandsAloneHasSkyToItsSides) {
  ViewMeasures m = good_measures();
  m.skyline.mean = 0.27, m.skyline.low = 0.38;
  const auto lost = [&](double lone) {
    ScoreContext c = context();
    c.lone = lone;
    double sum = 0.0;
    for (const ScoreTerm& term : score_terms(m, c))
      if (term.name == "sky" || term.name == "level") sum += term.points();
    return sum;
  };
  EXPECT_EQ(lost(1.0), 0.0);
  EXPECT_LT(lost(0.0), -1.5);
  EXPECT_EQ(lost(0.4), lost(0.0)) << "the first among others does not stand alone";
}

TEST(ViewScore, AHumpCostsAndIsTold) {
  ViewMeasures m = good_measures();
  m.skyline.hump = 0.5;
  EXPECT_NEAR(total(score_terms(good_measures(), context())) - total(score_terms(m, context())),
              0.6, 1e-9);
  for (const ScoreTerm& term : score_terms(m, context()))
    if (term.name == "hump") {
      EXPECT_NE(std::string(term.advice()).find("one hump"), std::string::npos);
    }
}

TEST(ViewScore, GainsAreToldByPoints) {
  ViewMeasures worse = good_measures();
  worse.visible_ground = 0.4;      // of 1.5 points
  worse.floor.depth_spread = 0.5;  // of .8
  worse.floor.width_spread = 0.9;  // of .5
  worse.skyline.low = 0.16;        // no loss
  EXPECT_EQ(describe_gains(score_terms(worse, context()), score_terms(good_measures(), context())),
            "ground 40 to 80 %, depth 50 to 100 %");
  EXPECT_EQ(describe_gains(score_terms(worse, context()), score_terms(worse, context())),
            "a little of everything");
}

TEST(ViewScore, CanyonsLeadOnPlateausSummitsInMountains) {
  const auto points = [](AnchorKind kind, double plateau) {
    ScoreContext c = context();
    c.plateau = plateau;
    c.anchors[0].kind = kind;
    ViewMeasures m = good_measures();
    m.anchors[0].position =
        kind == AnchorKind::canyon ? glm::dvec2(0.5, 0.5) : glm::dvec2(0.35, 0.08);
    return total(score_terms(m, c));
  };
  EXPECT_GT(points(AnchorKind::canyon, 1.0), points(AnchorKind::summit, 1.0));
}

TEST(ViewScore, TheTableHasNoRowTwiceAndSaysWhatItMeans) {
  std::set<std::string_view> names;
  for (const ScoreTerm& term : score_terms(good_measures(), context())) {
    EXPECT_TRUE(names.insert(term.name).second) << term.name;
    EXPECT_FALSE(term.meaning.empty()) << term.name;
  }
}

}  // namespace
}  // namespace belvedere
