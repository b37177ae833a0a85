#include "renderer/image/icc/ink_count.h"

#include <gtest/gtest.h>

namespace belvedere {
namespace {

TEST(InkCount, SumsInksOfPixels) {
  Grid<Inks> rows(4, 1, Inks(0.0F));
  rows(1, 0) = {1.0F, 1.0F, 1.0F, 1.0F};      // 400 %
  rows(2, 0) = {0.75F, 0.75F, 0.75F, 0.75F};  // 300 %, the limit itself
  rows(3, 0) = {0.5F, 0.0F, 0.0F, 0.5F};      // 100 %
  InkCount count(300.0);
  count.add(rows);
  count.add(Grid<Inks>(4, 3, Inks(0.0F)));
  const InkCoverage found = count.coverage();
  EXPECT_EQ(found.pixels, 16U);
  EXPECT_EQ(found.pixels_above, 1U);
  EXPECT_DOUBLE_EQ(found.above_share(), 1.0 / 16.0);
  EXPECT_DOUBLE_EQ(found.highest_percent, 400.0);
  EXPECT_NEAR(found.mean_percent, 800.0 / 16.0, 1e-4);
}

TEST(InkCount, OfNothingIsNothing) {
  const InkCoverage found = InkCount(300.0).coverage();
  EXPECT_EQ(found.mean_percent, 0.0);
  EXPECT_EQ(found.above_share(), 0.0);
}

}  // namespace
}  // namespace belvedere
