#include "terrain/generalize/foreground_share.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace belvedere {
namespace {

TEST(ForegroundShare, IsTheLineBetweenItsRoundedEnds) {
  const auto at = [](double t) { return foreground_share(2000.0 + 8000.0 * t, 2000.0, 10000.0); };
  for (const double t : {0.125, 0.3, 0.5, 0.7, 0.875}) EXPECT_NEAR(at(t), 1.0 - t, 1e-12) << t;
  EXPECT_EQ(at(-0.125), 1.0);
  EXPECT_EQ(at(1.125), 0.0);
  EXPECT_EQ(foreground_share(0.0, 2000.0, 10000.0), 1.0);
  EXPECT_EQ(foreground_share(1e9, 2000.0, 10000.0), 0.0);
  EXPECT_NEAR(at(0.0), 1.0 - 0.125 / 4.0, 1e-12);
  EXPECT_NEAR(at(1.0), 0.125 / 4.0, 1e-12);
}

TEST(ForegroundShare, IsNowhereSteeperThanTheLineAndHasNoCrease) {
  const double step = 1e-3;
  double slope = 0.0;
  for (double t = -0.5; t < 1.5; t += step) {
    const double next =
        (foreground_share(t, 0.0, 1.0) - foreground_share(t + step, 0.0, 1.0)) / step;
    EXPECT_GE(next, 0.0) << t;
    EXPECT_LE(next, 1.0 + 1e-9) << t;
    EXPECT_LE(std::abs(next - slope), 1.01 * step / 0.25)
        << t;  // the slope turns by no more than the parabola's
    slope = next;
  }
}

}  // namespace
}  // namespace belvedere
