#include "terrain/generalize/foreground_share.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace belvedere {
namespace {

TEST(ForegroundShare, ReachesItsValuesAtTheDistancesGiven) {
  const auto at = [](double t) { return foreground_share(2000.0 + 8000.0 * t, 2000.0, 10000.0); };
  for (const double t : {-0.25, -0.125, -1e-6, 0.0}) EXPECT_EQ(at(t), 1.0) << t;
  for (const double t : {1.0, 1.0 + 1e-6, 1.125, 100.0}) EXPECT_EQ(at(t), 0.0) << t;
  EXPECT_LT(at(1e-3), 1.0);
  EXPECT_GT(at(1.0 - 1e-3), 0.0);
  EXPECT_EQ(at(0.5), 0.5);
  // 1 - 4 s t² with the slope s = 8/7 to an eighth, the line 1/2 - s (t - 1/2), and its mirror
  // image.
  for (const double t : {0.03, 0.1, 0.125}) {
    EXPECT_NEAR(at(t), 1.0 - 32.0 / 7.0 * t * t, 1e-12) << t;
    EXPECT_NEAR(at(1.0 - t), 32.0 / 7.0 * t * t, 1e-12) << t;
  }
  for (const double t : {0.125, 0.3, 0.5, 0.7, 0.875})
    EXPECT_NEAR(at(t), 0.5 - 8.0 / 7.0 * (t - 0.5), 1e-12) << t;
}

TEST(ForegroundShare, IsHardlySteeperThanALineAndHasNoCrease) {
  const double step = 1e-3;
  double slope = 0.0;
  for (double t = -0.5; t < 1.5; t += step) {
    const double next =
        (foreground_share(t, 0.0, 1.0) - foreground_share(t + step, 0.0, 1.0)) / step;
    EXPECT_GE(next, 0.0) << t;
    EXPECT_LE(next, 8.0 / 7.0 + 1e-9) << t;
    EXPECT_LE(std::abs(next - slope), 1.01 * step * 64.0 / 7.0)
        << t;  // the slope turns by no more than the parabola's
    slope = next;
  }
}

}  // namespace
}  // namespace belvedere
