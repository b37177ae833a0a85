#include "renderer/compose/view_changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/compose/proposed_scene.h"
#include "tests/grids.h"
#include "tests/renderer/compose/synthetic_region.h"

namespace belvedere {
namespace {

using testing::HasSubstr;

// Narrow valleys between ridges, with floors mostly too narrow to be visible, and a peak.
double narrow(double e, double n) {
  const double ridges = 900.0 * std::abs(std::sin(0.55 * e)) * (0.7 + 0.3 * std::sin(0.4 * n));
  const double peak =
      900.0 * std::exp(-(std::pow((e - 26.0) / 5.0, 2.0) + std::pow((n - 34.0) / 5.0, 2.0)));
  return 700.0 + 6.0 * n + ridges + peak;
}

class ViewChangesOf : public testing::Test {
 protected:
  static std::vector<Candidate> some(const ViewSearch& search) {
    const std::vector<Candidate> candidates = first_candidates(search);
    std::vector<Candidate> out;
    for (std::size_t i = 0; i < candidates.size(); i += candidates.size() / 12)
      out.push_back(*judge(search, candidates[i].plan));
    return out;
  }
  CoarseGround ground_ = make_coarse_ground(test::synthetic_raster(60.0, narrow), 300.0);
  Massifs massifs_ = find_massifs(ground_);
  ViewSearch search_{ground_, massifs_, {}};
};

TEST_F(ViewChangesOf, NothingIsDoneWhereItWinsLittle) {
  const CoarseGround ground = test::cone_region();
  const Massifs massifs = find_massifs(ground);
  const ViewSearch search{ground, massifs, {}};
  const std::vector<WideGround> wide = widen_grounds(ground);
  int left = 0;
  for (const Candidate& before : some(search)) {
    const Candidate after = with_changes(search, wide, before);
    if (after.changes.widen_valleys_m > 0.0 || !after.changes.summits.empty()) continue;
    ++left;
    EXPECT_EQ(after.score, before.score);
    EXPECT_EQ(describe_changes(search, after), "");
  }
  EXPECT_GT(left, 0);
}

TEST_F(ViewChangesOf, AreTakenWhereTheyWinMuch) {
  const std::vector<WideGround> wide = widen_grounds(ground_);
  ASSERT_EQ(wide.size(), 2U);
  EXPECT_LT(wide[0].width_m, wide[1].width_m);
  int widened = 0, raised = 0;
  for (const Candidate& before : some(search_)) {
    const Candidate after = with_changes(search_, wide, before);
    const ViewChanges& changes = after.changes;
    widened += changes.widen_valleys_m > 0.0 ? 1 : 0;
    raised += changes.summits.empty() ? 0 : 1;
    EXPECT_LE(changes.summits.size(), 2U);
    if (changes.widen_valleys_m == 0.0 && changes.summits.empty()) continue;
    const double min = (changes.widen_valleys_m > 0.0 ? 0.2 : 0.0) +
                       0.25 * static_cast<double>(changes.summits.size());
    EXPECT_GE(after.score, before.score + min - 1e-9);
    EXPECT_THAT(describe_changes(search_, after), HasSubstr("improve"));
    // Evaluated again from scratch, on the ground of the candidate.
    CoarseGround ground =
        changes.widen_valleys_m > 0.0 ? widened_ground(ground_, changes.widen_valleys_m) : ground_;
    Massifs massifs = massifs_;
    std::vector<SummitExaggeration> summits;
    double gains = changes.widen_valleys_m > 0.0 ? changes.widened.merit : 0.0;
    for (const RaisedSummit& summit : changes.summits) {
      Anchor& anchor = massifs.anchors[static_cast<std::size_t>(summit.anchor)];
      const double more = (summit.by.factor - 1.0) * (anchor.altitude_m - summit.by.base_m);
      anchor.altitude_m += more, anchor.stands_m += more;
      summits.push_back(summit.by);
      gains += summit.gain.merit;
    }
    ground = raised_ground(ground, summits);
    EXPECT_NEAR(judge({ground, massifs, {}}, after.plan)->score, after.score, 1e-9);
    EXPECT_NEAR(before.merit + gains, after.merit, 1e-9) << "each says its own part";
  }
  EXPECT_GT(widened, 0);
  EXPECT_GT(raised, 0);
}

TEST_F(ViewChangesOf, PlainProposalsHaveNone) {
  const auto changed = [&](bool plain) {
    ViewRequest request;
    request.plain = plain;
    int count = 0;
    for (const Candidate& view : propose_views({ground_, massifs_, request}, {.max = 5}))
      if (view.changes.widen_valleys_m > 0.0 || !view.changes.summits.empty()) ++count;
    return count;
  };
  EXPECT_EQ(changed(true), 0);
  EXPECT_GT(changed(false), 0);
}

// A valley from north to south between two ranges, its floor falling southwards.
double valley(double e, double n) {
  const double wall = std::min(1500.0, 330.0 * std::abs(e - 30.0));
  return 500.0 + 4.0 * n + wall + 40.0 * std::sin(0.8 * n) * std::min(1.0, wall / 300.0);
}

int floor_cells(const CoarseGround& ground) {
  return static_cast<int>(std::count_if(ground.cells.begin(), ground.cells.end(),
                                        [](const GroundCell& c) { return c.floor; }));
}

TEST(GroundChanges, WiderValleysHaveMoreFloorInTheSameRegion) {
  const CoarseGround ground = make_coarse_ground(test::synthetic_raster(60.0, valley), 300.0);
  const CoarseGround wide = widened_ground(ground, 1500.0);
  EXPECT_GT(floor_cells(wide), floor_cells(ground) + 200) << "of 200 rows";
  EXPECT_EQ(wide.side_m, ground.side_m);
  EXPECT_EQ(wide.relief_m, ground.relief_m);
  EXPECT_EQ(wide.plateau, ground.plateau);
  for (std::size_t i = 0; i < ground.cells.size(); ++i) {
    ASSERT_EQ(wide.cells[i].rim_m, ground.cells[i].rim_m);
    ASSERT_EQ(wide.cells[i].known, ground.cells[i].known);
  }
  // The ridges keep their height, the wall above the old floor has gone.
  const auto rise = [&](double e) {
    return wide.altitude_m(test::position_km(e, 30.0)) -
           ground.altitude_m(test::position_km(e, 30.0));
  };
  EXPECT_NEAR(rise(10.0), 0.0, 10.0);
  EXPECT_LT(rise(30.75), -45.0);
}

TEST(GroundChanges, WhatIsUnknownStaysUnknown) {
  Raster<float> raster = test::synthetic_raster(60.0, valley);
  for (const auto [x, y] : test::cells(40, 200)) raster.cells(x, y) = NAN;
  const CoarseGround ground = make_coarse_ground(raster, 300.0);
  const CoarseGround wide = widened_ground(ground, 1000.0);
  for (std::size_t i = 0; i < ground.cells.size(); ++i)
    ASSERT_EQ(wide.cells[i].known, ground.cells[i].known);
}

TEST(GroundChanges, SummitsAreRaisedByThemselves) {
  const CoarseGround ground = test::cone_region();
  const SummitExaggeration by{
      .centre = test::position_km(30.0, 30.0), .radius_m = 5000.0, .factor = 1.3, .base_m = 1200.0};
  const CoarseGround raised = raised_ground(ground, {by});
  const GroundCell& before = *ground.at(by.centre);
  const GroundCell& after = *raised.at(by.centre);
  const double rise = static_cast<double>(after.altitude_m - before.altitude_m);
  EXPECT_NEAR(rise, 0.3 * (static_cast<double>(before.altitude_m) - 1200.0), 5.0)
      << "a cell beside the middle";
  EXPECT_NEAR(static_cast<double>(after.above_m - before.above_m), rise, 1e-3);
  int kept = 0;
  for (const auto [x, y] : test::cells(200, 200)) {
    const glm::dvec2 off = ground.transform.to_crs(x, y) - by.centre;
    if (off.x * off.x + off.y * off.y >= 25e6)
      kept += raised.cells(x, y) == ground.cells(x, y) ? 1 : -1000000;
  }
  EXPECT_GT(kept, 30000) << "beyond the radius all is as it was";
}

}  // namespace
}  // namespace belvedere
