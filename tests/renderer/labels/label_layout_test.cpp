#include "renderer/labels/label_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace belvedere {
namespace {

constexpr LabelLayoutParameters sheet{.width_px = 1000,
                                      .height_px = 500,
                                      .margin_px = 5.0,
                                      .clearance_px = 2.0,
                                      .gap_px = 3.0,
                                      .row_px = 16.0,
                                      .longest_leader_px = 200.0};
const std::vector<double> no_sky(1000, 0.0);

LabelRequest summit(double x, double y, double rank = 5.0, double width = 80.0) {
  return {.mark = {x, y},
          .mark_px = 6.0,
          .width_px = width,
          .height_px = 12.0,
          .position = LabelPlace::above,
          .rank = rank};
}

LabelBox leader_of(const LabelRequest& request, const LabelSpot& spot) {
  return {request.mark.x - .5, spot.leader_end.y, request.mark.x + .5,
          request.mark.y - .5 * request.mark_px};
}

TEST(LabelLayout, ALoneSummitHasItsNameOverIt) {
  const std::vector<LabelSpot> spots = place_labels({summit(400.0, 300.0)}, no_sky, sheet);
  ASSERT_TRUE(spots[0].placed);
  EXPECT_DOUBLE_EQ(spots[0].text.bottom, 300.0 - 3.0 - 3.0) << "half the mark and the gap";
  EXPECT_DOUBLE_EQ(.5 * (spots[0].text.left + spots[0].text.right), 400.0);
  EXPECT_FALSE(spots[0].has_leader);
}

TEST(LabelLayout, TheSecondOfTwoNeighboursStandsHigherOnALeader) {
  const std::vector<LabelRequest> requests = {summit(400.0, 300.0, 2.0),
                                              summit(425.0, 300.0, 1.0, 46.0)};
  const std::vector<LabelSpot> spots = place_labels(requests, no_sky, sheet);
  ASSERT_TRUE(spots[0].placed && spots[1].placed);
  EXPECT_FALSE(spots[1].has_leader) << "the better rank";
  EXPECT_TRUE(spots[0].has_leader);
  EXPECT_DOUBLE_EQ(spots[0].leader_end.y, spots[0].text.bottom);
  EXPECT_FALSE(leader_of(requests[0], spots[0]).overlaps(spots[1].text))
      << "which passes beside the other's name";
}

// Offsets are from the mark to the centre of the foot of the text.
TEST(LabelLayout, ANamePlacedByHandStaysAndOthersMakeRoom) {
  std::vector<LabelRequest> requests = {summit(400.0, 300.0, 1.0), summit(330.0, 340.0, 9.0)};
  requests[1].by_hand_px = glm::dvec2(30.0, -46.0);  // where the first would have its name
  const std::vector<LabelSpot> spots = place_labels(requests, no_sky, sheet);
  ASSERT_TRUE(spots[0].placed && spots[1].placed);
  EXPECT_DOUBLE_EQ(.5 * (spots[1].text.left + spots[1].text.right), 360.0);
  EXPECT_DOUBLE_EQ(spots[1].text.bottom, 294.0);
  EXPECT_FALSE(spots[0].text.overlaps(spots[1].text)) << "although it has the better rank";
  requests[0].by_hand_px = glm::dvec2(0.0, -6.0);
  EXPECT_TRUE(place_labels(requests, no_sky, sheet)[0].placed) << "on top of each other, if asked";
}

TEST(LabelLayout, TheLeaderOfANamePlacedByHandEndsAtItsText) {
  LabelRequest request = summit(400.0, 300.0);
  for (const glm::dvec2 by : {glm::dvec2(150.0, -100.0), glm::dvec2(-150.0, 90.0)}) {
    request.by_hand_px = by;
    const LabelSpot spot = place_labels({request}, no_sky, sheet)[0];
    ASSERT_TRUE(spot.has_leader);
    EXPECT_GE(spot.leader_end.x, spot.text.left);
    EXPECT_LE(spot.leader_end.x, spot.text.right);
    EXPECT_DOUBLE_EQ(spot.leader_end.y, by.y < 0.0 ? spot.text.bottom : spot.text.top);
  }
  request.by_hand_px = glm::dvec2(0.0, -6.0);
  EXPECT_FALSE(place_labels({request}, no_sky, sheet)[0].has_leader) << "beside its mark";
  request.by_hand_px = glm::dvec2(5000.0, 0.0);
  EXPECT_DOUBLE_EQ(place_labels({request}, no_sky, sheet)[0].text.right, 995.0)
      << "never outside the picture";
}

// Names of the skyline are on rows that count from the margin, whatever their summits' heights.
TEST(LabelLayout, TheSkylinesNamesStandInRowsAboveIt) {
  std::vector<LabelRequest> requests;
  for (const double x : {150.0, 420.0, 700.0}) requests.push_back(summit(x, 200.0 + .1 * x));
  for (LabelRequest& request : requests) request.on_skyline = true;
  std::vector<double> skyline(1000, 215.0);
  for (std::size_t x = 370; x < 400; ++x)
    skyline[x] = 150.0;  // a tower beside the second one, as wide as its name reaches
  const std::vector<LabelSpot> spots = place_labels(requests, skyline, sheet);
  for (const LabelSpot& spot : spots) {
    ASSERT_TRUE(spot.placed);
    EXPECT_NEAR(std::remainder(spot.text.bottom - 5.0 - 12.0, 16.0), 0.0, 1e-9);
    EXPECT_LE(spot.text.bottom + 2.0, 215.0);
  }
  EXPECT_TRUE(spots[1].text.left >= 400.0 || spots[1].text.bottom <= 148.0)
      << "nothing of the tower lies behind it";
}

TEST(LabelLayout, RanksDecideWhoIsLeftOut) {
  // Names of lakes have one position only: on top of each other, of five ranks, in no order.
  std::vector<LabelRequest> requests;
  for (const double rank : {4.0, 2.0, 5.0, 1.0, 3.0})
    requests.push_back({.mark = {500.0, 250.0},
                        .width_px = 900.0,
                        .height_px = 12.0,
                        .position = LabelPlace::over,
                        .rank = rank});
  const std::vector<LabelSpot> spots = place_labels(requests, no_sky, sheet);
  double worst_placed = 0.0;
  double best_left_out = 9.0;
  for (std::size_t i = 0; i < spots.size(); ++i)
    (spots[i].placed ? worst_placed = std::max(worst_placed, requests[i].rank)
                     : best_left_out = std::min(best_left_out, requests[i].rank));
  EXPECT_EQ(worst_placed, 3.0) << "in the middle and over and under it there is room for three";
  EXPECT_EQ(best_left_out, 4.0);
}

TEST(LabelLayout, ANameMovesWhereThatMakesRoomForAnother) {
  // The town's first choice, its upper right, takes the only position of the lake between two
  // marks.
  const LabelRequest town{.mark = {480.0, 250.0},
                          .mark_px = 6.0,
                          .width_px = 60.0,
                          .height_px = 12.0,
                          .position = LabelPlace::beside,
                          .rank = 1.0};
  const LabelRequest lake{.mark = {515.0, 245.0},
                          .width_px = 40.0,
                          .height_px = 12.0,
                          .position = LabelPlace::over,
                          .rank = 2.0};
  const LabelSpot alone = place_labels({town}, no_sky, sheet)[0];
  const std::vector<LabelSpot> both = place_labels({town, lake}, no_sky, sheet);
  ASSERT_TRUE(both[0].placed && both[1].placed);
  EXPECT_GT(alone.text.left, 480.0);
  EXPECT_FALSE(both[0].text.overlaps(both[1].text));
}

TEST(LabelLayout, NothingLeavesTheSheet) {
  const std::vector<LabelSpot> spots =
      place_labels({summit(10.0, 300.0), summit(995.0, 300.0), summit(500.0, 8.0),
                    summit(-5.0, 100.0), summit(500.0, 300.0, 5.0, 995.0)},
                   no_sky, sheet);
  EXPECT_FALSE(spots[2].placed) << "no row above";
  EXPECT_FALSE(spots[3].placed) << "its mark lies outside";
  EXPECT_FALSE(spots[4].placed) << "wider than the sheet";
  for (const LabelSpot& spot : spots)
    if (spot.placed) {
      EXPECT_GE(spot.text.left, 5.0);
      EXPECT_GE(spot.text.top, 5.0);
      EXPECT_LE(spot.text.right, 995.0);
      EXPECT_LE(spot.text.bottom, 495.0);
    }
}

// Two hundred names with room for fewer: placed names never overlap anything, each name left out
// has a rank no better than those that block it, and order only decides between equals.
class CrowdedLabels : public testing::TestWithParam<std::uint64_t> {
 protected:
  static std::vector<LabelRequest> crowd(std::uint64_t seed) {
    std::vector<LabelRequest> requests;
    const auto draw = [&](std::int64_t i, std::int64_t n) { return random_uniform(seed, i, n); };
    for (std::int64_t i = 0; i < 200; ++i) {
      LabelRequest request = summit(1000.0 * draw(i, 0), 60.0 + 440.0 * draw(i, 1),
                                    std::floor(1.0 + 9.0 * draw(i, 2)), 30.0 + 90.0 * draw(i, 3));
      const double kind = draw(i, 4);
      request.position = kind < .6    ? LabelPlace::above
                         : kind < .85 ? LabelPlace::beside
                                      : LabelPlace::over;
      if (request.position == LabelPlace::over) request.mark_px = 0.0;
      request.on_skyline = request.position == LabelPlace::above && request.mark.y < 120.0;
      requests.push_back(request);
    }
    return requests;
  }
};

TEST_P(CrowdedLabels, NeverOverlap) {
  const std::vector<LabelRequest> requests = crowd(GetParam());
  const std::vector<LabelSpot> spots =
      place_labels(requests, std::vector<double>(1000, 100.0), sheet);
  std::size_t placed = 0;
  for (std::size_t i = 0; i < spots.size(); ++i) {
    if (!spots[i].placed) continue;
    ++placed;
    for (std::size_t j = 0; j < spots.size(); ++j) {
      if (i == j || !spots[j].placed) continue;
      EXPECT_FALSE(spots[i].text.overlaps(spots[j].text)) << i << " over " << j;
      const glm::dvec2 m = requests[j].mark;
      const double r = .5 * requests[j].mark_px;
      EXPECT_FALSE(r > 0.0 && spots[i].text.overlaps({m.x - r, m.y - r, m.x + r, m.y + r}))
          << i << " over the mark of " << j;
      EXPECT_FALSE(spots[j].has_leader && spots[i].text.overlaps(leader_of(requests[j], spots[j])))
          << i << " over the leader of " << j;
    }
  }
  EXPECT_GT(placed, 90U);
  for (std::size_t i = 0; i < spots.size(); ++i)
    EXPECT_TRUE(spots[i].placed || requests[i].rank > 1.0 ||
                requests[i].position != LabelPlace::above ||
                std::abs(requests[i].mark.x - 500.0) > 400.0)
        << "the best find room: " << i;
}

INSTANTIATE_TEST_SUITE_P(Seeds, CrowdedLabels, testing::Values(1U, 2U, 3U, 4U, 5U));

}  // namespace
}  // namespace belvedere
