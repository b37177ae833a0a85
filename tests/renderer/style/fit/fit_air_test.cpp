#include "renderer/style/fit/fit_air.h"

#include <gtest/gtest.h>

#include "tests/renderer/style/synthetic_painting.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

TEST(FitAir, FarAirOfTheMaskGoesBeforeGuesses) {
  test::Landscape landscape = test::make_landscape();
  const StylePainting inferred = prepare_painting(landscape.picture, landscape.mask);
  const glm::dvec3 horizon(0.85, -0.01, -0.02);
  const StyleAir without = fit_air(inferred, horizon);
  EXPECT_FALSE(without.far_seen);
  EXPECT_NEAR(without.mist.y, 0.5 * (without.far.y + horizon.y), 1e-12);
  for (int y = 24; y < 34; ++y)
    for (int x = 0; x < landscape.mask.width(); ++x) {
      landscape.mask(x, y) = far_air_label;
      landscape.picture(x, y) = from_oklab({0.7, -0.03, -0.08});
    }
  const StyleAir with = fit_air(prepare_painting(landscape.picture, landscape.mask), horizon);
  EXPECT_TRUE(with.far_seen);
  EXPECT_NEAR(with.far.z, 0.5 * -0.08 + 0.5 * horizon.z, 2e-3);
  EXPECT_GE(with.far.x, with.near.x + 0.06 - 1e-12);
}

TEST(FitAir, LeavesAreColoursOfLitVegetation) {
  const test::Landscape landscape = test::make_landscape();
  const StyleAir air = fit_air(prepare_painting(landscape.picture, landscape.mask), std::nullopt);
  for (const glm::dvec3& leaf : air.leaves) {
    EXPECT_LT(leaf.y, -0.03);
    EXPECT_GT(leaf.z, 0.03);
    EXPECT_GT(leaf.x, 0.5);
  }
  EXPECT_GE(air.haze, 0.7);
  EXPECT_LE(air.haze, 1.25);
}

}  // namespace
}  // namespace belvedere
