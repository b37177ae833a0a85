#include "base/statistics.h"

#include <gtest/gtest.h>

#include <vector>

namespace belvedere {
namespace {

TEST(Median, IsTheMiddleOneOrTheMeanOfTwo) {
  EXPECT_EQ(median({}), 0.0);
  EXPECT_EQ(median({7.0}), 7.0);
  EXPECT_EQ(median({9.0, 1.0, 4.0}), 4.0);
  EXPECT_EQ(median({9.0, 1.0, 4.0, 2.0}), 3.0);
}

TEST(Percentile, IsTheValueAtTheNearestRank) {
  const std::vector<double> values = {40.0, 0.0, 30.0, 10.0, 20.0};  // ranks 0…4
  EXPECT_EQ(percentile(values, 0.0), 0.0);
  EXPECT_EQ(percentile(values, 0.24), 10.0);
  EXPECT_EQ(percentile(values, 0.5), 20.0);
  EXPECT_EQ(percentile(values, 0.9), 40.0);
  EXPECT_EQ(percentile(values, 1.0), 40.0);
  EXPECT_EQ(percentile({}, 0.5), 0.0);
}

}  // namespace
}  // namespace belvedere
