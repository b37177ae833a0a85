#include "renderer/mist/mist_bed.h"

#include <gtest/gtest.h>

#include <cmath>

namespace belvedere {
namespace {

constexpr double cell = 60.0;

// A valley that runs north: floor 1 km wide at 800 m, sides that rise by 60 in 100 to 2000 m.
double valley_m(double east) {
  return 800.0 + 0.6 * std::min(2000.0, std::max(0.0, std::abs(east - 9000.0) - 500.0));
}

MistGround valley_ground(bool floors = true) {
  Grid<float> altitude(300, 300);
  for (int y = 0; y < 300; ++y)
    for (int x = 0; x < 300; ++x) altitude(x, y) = static_cast<float>(valley_m((x + 0.5) * cell));
  const Grid<float> rim(300, 300, 1e6F);
  return make_mist_ground(altitude, rim, {0.0, 18000.0, cell, cell}, floors);
}

TEST(MistBed, ASeaLiesAtItsAltitude) {
  const MistGround ground = valley_ground(false);
  MistBed bed({.to_m = 1400.0, .position = {}}, ground, 0.0, 1);
  EXPECT_EQ(bed.highest_m(), 1400.0);
  for (const double x : {100.0, 9000.0, 15000.0}) {
    EXPECT_EQ(bed.at({x, 5000.0}).top_m, 1400.0);
    EXPECT_EQ(bed.at({x, 5000.0}).cover, 1.0);
  }
}

TEST(MistBed, ASeaEndsAtItsRadiusAndBeforeTheEndOfTheTerrain) {
  MistGround ground = valley_ground(false);
  MistBed round({.to_m = 1400.0, .position = glm::dvec2(9000.0, 9000.0), .radius_m = 4000.0},
                ground, 0.0, 1);
  EXPECT_EQ(round.at({9000.0, 11900.0}).cover, 1.0);
  EXPECT_EQ(round.at({9000.0, 13001.0}).cover, 0.0);
  for (float& rim : ground.rim_m) rim = 1000.0F;
  MistBed rimmed({.to_m = 1400.0, .position = {}}, ground, 2000.0, 1);
  EXPECT_NEAR(rimmed.at({9000.0, 9000.0}).cover, 0.5, 1e-6);
}

TEST(MistBed, MistOfValleysLiesOnTheirFloorsAlone) {
  const MistGround ground = valley_ground();
  MistBed bed({.kind = MistKind::valley, .height_m = 150.0, .patches = 0.0, .position = {}}, ground,
              0.0, 1);
  const MistBed::Column floor = bed.at({9000.0, 9000.0});
  EXPECT_NEAR(floor.top_m, 800.0 + 150.0, 25.0);
  EXPECT_GT(floor.cover, 0.8);
  const MistBed::Column slope = bed.at({10600.0, 9000.0});
  EXPECT_TRUE(slope.cover < 0.05 || slope.top_m < valley_m(10600.0))
      << slope.cover << " " << slope.top_m;
  const MistBed::Column high = bed.at({15500.0, 9000.0});
  EXPECT_LT(high.cover, 0.2) << "a plateau is no valley";
  EXPECT_LE(floor.top_m, bed.highest_m());
}

TEST(MistBed, PatchesTearIt) {
  const MistGround ground = valley_ground();
  const auto covered = [&](double patches) {
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      MistBed bed({.kind = MistKind::valley, .height_m = 150.0, .patches = patches, .position = {}},
                  ground, 0.0, seed);
      for (int k = 0; k < 170; ++k)
        sum += bed.at({9000.0, 500.0 + 100.0 * k}).cover / (12.0 * 170.0);
    }
    return sum;
  };
  EXPECT_GT(covered(0.0), 0.8);
  EXPECT_LT(covered(0.6), 0.75 * covered(0.0));
  EXPECT_LT(covered(0.95), covered(0.6));
}

}  // namespace
}  // namespace belvedere
