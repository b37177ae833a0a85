#include "base/colour/water_colour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace belvedere {
namespace {

TEST(WaterColour, TurnsFromTheBedToPaleToDeep) {
  const glm::vec3 ground(200.F, 150.F, 90.F);
  EXPECT_EQ(water_colour(ground, 0.F), ground);
  EXPECT_LT(glm::distance(water_colour(ground, 0.05F), ground), 15.F);
  // Beyond that, deeper water gets darker and the ground no longer matters.
  float before = 1e9F;
  for (const float depth : {4.F, 8.F, 16.F, 40.F, 150.F}) {
    const glm::vec3 water = water_colour(ground, depth);
    const float luminance = water.x + water.y + water.z;
    EXPECT_LT(luminance, before);
    before = luminance;
    EXPECT_LT(glm::distance(water, water_colour({0.F, 0.F, 0.F}, depth)), 0.05F * 265.F);
  }
}

// Light falls as e^(-depth): at 1.2 m · ln 2 half of the bed is left, and 2^(-1.2 / 9) of the pale
// water.
TEST(WaterColour, HalfOfTheBedIsLostAtItsHalfDepth) {
  const WaterColours water{{0.4F, 0.8F, 0.6F}, {0.1F, 0.2F, 0.5F}};
  const glm::vec3 ground(0.9F, 0.7F, 0.3F);
  const auto half_m = static_cast<float>(1.2 * std::log(2.0));
  const auto pale = static_cast<float>(std::exp2(-1.2 / 9.0));
  const glm::vec3 expected =
      0.5F * ground + 0.5F * (pale * water.shallow + (1.F - pale) * water.deep);
  EXPECT_LT(glm::distance(water_colour(ground, half_m, water), expected), 1e-6F);
  EXPECT_LT(glm::distance(water_colour(ground, 500.F, water), water.deep), 1e-6F);
}

}  // namespace
}  // namespace belvedere
