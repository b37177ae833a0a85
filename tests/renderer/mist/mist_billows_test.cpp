#include "renderer/mist/mist_billows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace belvedere {
namespace {

constexpr double metres_per_unit = 20.0;

TEST(MistBillows, WithoutStrengthTheSurfaceIsFlat) {
  MistBillows flat(1, 0.0, 90.0);
  EXPECT_TRUE(flat.flat());
  EXPECT_EQ(flat.height_m({1234.0, 77.0}, metres_per_unit), 0.0);
}

TEST(MistBillows, HeapsStayWithinTheirReachAndAboutTheSurface) {
  for (const double metres : {3.0, 20.0, 70.0}) {
    MistBillows billows(3, 1.0, 90.0);
    double low = 1e9, high = -1e9, sum = 0.0;
    int count = 0;
    for (int y = 0; y < 120; ++y)
      for (int x = 0; x < 120; ++x, ++count) {
        const double height = billows.height_m({x * 11.0 * metres, y * 11.0 * metres}, metres);
        low = std::min(low, height), high = std::max(high, height), sum += height;
      }
    EXPECT_LE(high, billows.reach_m());
    EXPECT_GE(low, -billows.reach_m());
    EXPECT_GT(high - low, 0.5 * std::min(90.0, 0.085 * MistBillows::length_m(metres)));
    EXPECT_LT(std::abs(sum / count), 0.12 * (high - low)) << metres;
  }
}

TEST(MistBillows, TwiceTheStrengthIsTwiceTheHeight) {
  MistBillows one(5, 1.0, 90.0);
  MistBillows two(5, 2.0, 90.0);
  for (const double x : {10.0, 400.0, 9000.0})
    EXPECT_NEAR(two.height_m({x, 50.0}, metres_per_unit),
                2.0 * one.height_m({x, 50.0}, metres_per_unit), 1e-9);
}

// Octaves fade in and out with distance, without a jump.
TEST(MistBillows, DistanceChangesThemSmoothly) {
  MistBillows billows(7, 1.0, 90.0);
  double before = billows.height_m({5000.0, 7000.0}, 5.0);
  double largest = 0.0;
  for (double metres = 5.0; metres < 80.0; metres *= 1.005) {
    const double height = billows.height_m({5000.0, 7000.0}, metres);
    largest = std::max(largest, std::abs(height - before));
    before = height;
  }
  EXPECT_LT(largest, 3.0);
}

// A pure function of the position, whatever was evaluated before.
TEST(MistBillows, AnswersHangOnThePlaceAlone) {
  MistBillows one(9, 1.0, 90.0);
  MistBillows other(9, 1.0, 90.0);
  for (int k = 0; k < 50; ++k) one.height_m({k * 991.0, k * 317.0}, 5.0 + k);
  EXPECT_EQ(one.height_m({650123.0, 5230456.0}, 17.0), other.height_m({650123.0, 5230456.0}, 17.0));
}

}  // namespace
}  // namespace belvedere
