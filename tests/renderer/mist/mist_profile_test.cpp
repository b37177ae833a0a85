#include "renderer/mist/mist_profile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace belvedere {
namespace {

TEST(MistProfile, OverTheSightAFiftiethIsLeft) {
  const MistProfile mist = make_mist_profile(800.0, 0.0);
  EXPECT_NEAR(std::exp(-optical_depth(mist, 800.0, 100.0, 100.0)), 0.02, 1e-12);
}

TEST(MistProfile, NothingLiesAboveTheSurface) {
  const MistProfile mist = make_mist_profile(300.0, 80.0);
  EXPECT_EQ(extinction_at(mist, 0.0), 0.0);
  EXPECT_EQ(extinction_at(mist, -5.0), 0.0);
  EXPECT_EQ(optical_depth(mist, 1000.0, -400.0, -1.0), 0.0);
  EXPECT_EQ(optical_depth(mist, 1000.0, -1.0, -1.0), 0.0);
}

// Straight down through the edge and beyond: full · (depth - edge / 2).
TEST(MistProfile, StraightDownItIsTheIntegralOfARamp) {
  const MistProfile mist{0.01, 80.0};
  EXPECT_NEAR(optical_depth(mist, 40.0, 0.0, 40.0), 0.01 * 40.0 * 40.0 / 160.0, 1e-12);
  EXPECT_NEAR(optical_depth(mist, 300.0, 0.0, 300.0), 0.01 * (300.0 - 40.0), 1e-12);
  EXPECT_NEAR(optical_depth(mist, 500.0, -200.0, 300.0), 0.01 * (300.0 - 40.0), 1e-12);
}

// However a path is divided, the sum is the same, and equal to that of many small steps by the
// midpoint rule.
TEST(MistProfile, AWayIsTheSumOfItsParts) {
  const MistProfile mist{0.012, 60.0};
  const double length = 700.0;
  const double from = -90.0;
  const double to = 210.0;
  const auto below = [&](double t) { return from + (to - from) * t / length; };
  double parts = 0.0;
  double fine = 0.0;
  for (int k = 0; k < 7; ++k)
    parts += optical_depth(mist, 100.0, below(100.0 * k), below(100.0 * (k + 1)));
  for (int k = 0; k < 70000; ++k) fine += 0.01 * extinction_at(mist, below(0.01 * (k + 0.5)));
  EXPECT_NEAR(parts, optical_depth(mist, length, from, to), 1e-12);
  EXPECT_NEAR(fine, optical_depth(mist, length, from, to), 1e-6);
  EXPECT_NEAR(optical_depth(mist, length, to, from), optical_depth(mist, length, from, to), 1e-12);
}

TEST(MistProfile, LevelWaysAgreeWithNearlyLevelOnes) {
  const MistProfile mist{0.012, 60.0};
  EXPECT_NEAR(optical_depth(mist, 900.0, 30.0, 30.0), optical_depth(mist, 900.0, 29.99, 30.01),
              1e-9);
}

}  // namespace
}  // namespace belvedere
