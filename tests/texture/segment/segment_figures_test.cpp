#include "texture/segment/segment_figures.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "base/random.h"

namespace belvedere {
namespace {

using ::testing::ElementsAre;

Grid<std::uint16_t> groups_of(const std::vector<std::uint16_t>& values) {
  Grid<std::uint16_t> out(static_cast<int>(values.size()), 1);
  std::copy(values.begin(), values.end(), out.begin());
  return out;
}
Grid<std::uint8_t> labels_of(const std::vector<std::uint8_t>& values) {
  Grid<std::uint8_t> out(static_cast<int>(values.size()), 1);
  std::copy(values.begin(), values.end(), out.begin());
  return out;
}

TEST(SegmentFigures, TheSameUnderOtherNumbersIsPerfect) {
  const SegmentAgreement found =
      segment_agreement(groups_of({7, 7, 2, 2, 0}), labels_of({1, 1, 5, 5, 3}));
  EXPECT_DOUBLE_EQ(found.one_to_one, 1.0);
  EXPECT_DOUBLE_EQ(found.merged, 1.0);
  EXPECT_DOUBLE_EQ(found.accuracy, 1.0);
  EXPECT_EQ(found.groups, 3U);
}

// Label 0 of six pixels falls into three groups, of which the largest has three; label 1 of two has
// one of its own.
TEST(SegmentFigures, MergingMendsWhatIsSplit) {
  const SegmentAgreement found =
      segment_agreement(groups_of({0, 0, 0, 1, 1, 2, 3, 3}), labels_of({0, 0, 0, 0, 0, 0, 1, 1}));
  EXPECT_DOUBLE_EQ(found.one_to_one, (3.0 / 6.0 + 1.0) / 2.0);
  EXPECT_DOUBLE_EQ(found.merged, 1.0);
}

// One group over both labels is assigned to the larger: 3 of 4 for it, none for the other.
TEST(SegmentFigures, MergingDoesNotMendWhatIsJoined) {
  const SegmentAgreement found =
      segment_agreement(groups_of({0, 0, 0, 0}), labels_of({0, 0, 0, 1}));
  EXPECT_DOUBLE_EQ(found.merged, (3.0 / 4.0 + 0.0) / 2.0);
  EXPECT_DOUBLE_EQ(found.one_to_one, (3.0 / 4.0) / 2.0);
  EXPECT_DOUBLE_EQ(found.accuracy, 0.75);
}

TEST(SegmentFigures, WhatIsUnknownOrTooSmallCountsNowhere) {
  std::vector<std::uint8_t> labels(400, 0);
  std::vector<std::uint16_t> groups(400, 0);
  labels[0] = 1;  // a quarter of a percent
  labels[1] = unknown_label;
  groups[1] = 9;
  const SegmentAgreement found = segment_agreement(groups_of(groups), labels_of(labels));
  EXPECT_DOUBLE_EQ(found.merged, 1.0);
  EXPECT_DOUBLE_EQ(found.one_to_one, 1.0);
  EXPECT_THROW(segment_agreement(groups_of({0}), labels_of({0, 0})), Error);
}

// The greedy choice (9 first) sums to 10, the best to 16.
TEST(SegmentFigures, MatchingIsNotGreedy) {
  EXPECT_THAT(match_one_to_one({9, 8, 8, 1}, 2, 2), ElementsAre(1, 0));
}

TEST(SegmentFigures, MatchingIsTheBestOfAllOrders) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const std::size_t rows = 2 + seed % 4;
    const std::size_t columns = 2 + seed / 4 % 4;
    std::vector<double> values(rows * columns);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<double>(random_index(100, seed, static_cast<int>(i), 0));
    const std::vector<std::size_t> found = match_one_to_one(values, rows, columns);
    double sum = 0.0;
    std::vector<int> taken(columns, 0);
    for (std::size_t r = 0; r < rows; ++r) {
      if (found[r] == no_column) continue;
      sum += values[r * columns + found[r]];
      EXPECT_EQ(taken[found[r]]++, 0);
    }
    std::vector<std::size_t> order(std::max(rows, columns));
    std::iota(order.begin(), order.end(), std::size_t{0});
    double best = 0.0;
    do {
      double one = 0.0;
      for (std::size_t r = 0; r < rows; ++r)
        if (order[r] < columns) one += values[r * columns + order[r]];
      best = std::max(best, one);
    } while (std::next_permutation(order.begin(), order.end()));
    EXPECT_DOUBLE_EQ(sum, best) << seed;
  }
}

}  // namespace
}  // namespace belvedere
