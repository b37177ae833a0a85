#include "base/math.h"

#include <gtest/gtest.h>

#include <limits>

namespace belvedere {
namespace {

TEST(Math, SmoothstepIsTheCubicBetweenLevelEnds) {
  EXPECT_EQ(smoothstep(0.0), 0.0);
  EXPECT_EQ(smoothstep(0.25), 0.15625);
  EXPECT_EQ(smoothstep(0.5F), 0.5F);
  EXPECT_EQ(smoothstep(1.0), 1.0);
  EXPECT_EQ(smoothstep(-3.0), 0.0);
  EXPECT_EQ(smoothstep(7.0F), 1.0F);
  EXPECT_EQ(smoothstep(1000.0, 2000.0, 1250.0), 0.15625);
  EXPECT_EQ(smoothstep(1000.0, 2000.0, 900.0), 0.0);
  EXPECT_EQ(smoothstep(-std::numeric_limits<float>::infinity()), 0.0F);
  for (double t = 0.0; t <= 1.0; t += 0.0625)
    EXPECT_NEAR(smoothstep(t) + smoothstep(1.0 - t), 1.0, 1e-15) << t;
  constexpr double h = 1e-6;
  EXPECT_LT((smoothstep(h) - smoothstep(0.0)) / h, 1e-5) << "level at the lower end";
  EXPECT_LT((smoothstep(1.0) - smoothstep(1.0 - h)) / h, 1e-5) << "and at the upper";
  EXPECT_NEAR((smoothstep(0.5 + h) - smoothstep(0.5 - h)) / (2.0 * h), 1.5, 1e-9)
      << "steepest in the middle";
}

TEST(Math, UnitHoldsAndSquareSquares) {
  EXPECT_EQ(unit(-0.1F), 0.0F);
  EXPECT_EQ(unit(0.3), 0.3);
  EXPECT_EQ(unit(1.1), 1.0);
  EXPECT_EQ(square(-3.0F), 9.0F);
}

}  // namespace
}  // namespace belvedere
