#include "renderer/style/fit/ramp_lightness.h"

#include <gtest/gtest.h>

#include <cmath>

namespace belvedere {
namespace {

ClassRamps scaled_summer(double scale) {
  ClassRamps ramps = palette_ramps(read_palette("summer"));
  for (LabRamp& ramp : ramps)
    for (glm::dvec3& colour : ramp) colour *= scale;
  return ramps;
}

TEST(LightenRamps, ADarkPaintingReachesTheGoal) {
  const ClassRamps dark = scaled_summer(0.7);
  const LightenedRamps out = lighten_ramps(dark, 0.56, 0.97, LightLaw{});
  EXPECT_GE(ground_lightness(out.ramps), 0.56);
  EXPECT_LT(ground_lightness(out.ramps), 0.58);
  EXPECT_LT(out.power, 1.0);
  // One power of lightness keeps the order of lightness.
  for (std::size_t c = 1; c < dark.size(); ++c)
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(out.ramps[c][k].x, 0.97 * std::pow(dark[c][k].x / 0.97, out.power), 1e-6);
}

TEST(LightenRamps, TheLightestEndStays) {
  ClassRamps dark = scaled_summer(0.7);
  dark[index_of(LandCoverClass::snow)][3].x = 0.97;
  const LightenedRamps out = lighten_ramps(dark, 0.56, 0.97, LightLaw{});
  EXPECT_NEAR(out.ramps[index_of(LandCoverClass::snow)][3].x, 0.97, 1e-12);
}

TEST(LightenRamps, ALightPaintingStaysAsItIs) {
  const ClassRamps light = scaled_summer(1.0);
  const LightenedRamps out = lighten_ramps(light, 0.5, 0.97, LightLaw{});
  EXPECT_EQ(out.power, 1.0);
  EXPECT_EQ(out.ramps, light);
}

TEST(LightenRamps, EndsWhereNoPowerIsEnough) {
  EXPECT_GE(lighten_ramps(scaled_summer(0.1), 0.9, 0.97, LightLaw{}).power, 0.42);
}

}  // namespace
}  // namespace belvedere
