#include "renderer/style/fit/light_law.h"

#include <gtest/gtest.h>

#include "tests/renderer/style/synthetic_painting.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// Two classes of all lightnesses, in uniform rows of 6 px so that the blur within classes has
// little effect; `a` of a colour depends on its lightness, or on its class.
StylePainting two_classes(bool by_light) {
  Grid<glm::vec3> picture(128, 120);
  Grid<std::uint8_t> mask(128, 120);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 128; ++x) {
      mask(x, y) = test::label_of(x < 64 ? rock : pasture);
      const double light = 0.3 + 0.5 * (x % 64) / 63.0;
      const double a = by_light ? 0.2 * (light - 0.55) : x < 64 ? 0.04 : -0.04;
      picture(x, y) = from_oklab({light, a, 0.0});
    }
  CleanMaskParameters parameters;
  parameters.nearer = 0.0;  // keeps both classes whole
  return prepare_painting(picture, mask, parameters);
}

TEST(LightLaw, KnowsHueThatLightExplainsFromHueOfClasses) {
  const LightLaw light = fit_light_law(two_classes(true));
  EXPECT_GT(light.hue_by_light, 0.95);
  EXPECT_EQ(light.follow(), 1.0);
  EXPECT_EQ(light.mix(), 0.65);
  EXPECT_NEAR(light.ground_lightness, 0.55, 0.01);
  const LightLaw classes = fit_light_law(two_classes(false));
  EXPECT_LT(classes.hue_by_light, 0.05);
  EXPECT_EQ(classes.follow(), 0.3);
  EXPECT_EQ(classes.mix(), 0.0);
}

TEST(LightLaw, IsTheMeanHueAtThatLightness) {
  const LightLaw law = fit_light_law(two_classes(true));
  // Approximate, because weighted with chroma and smoothed.
  EXPECT_NEAR(law.at(0.45).x, 0.2 * (0.45 - 0.55), 0.008);
  EXPECT_NEAR(law.at(0.70).x, 0.2 * (0.70 - 0.55), 0.008);
  EXPECT_EQ(law.at(-1.0), law.at(0.0));
  EXPECT_EQ(law.at(2.0), law.at(1.0));
}

TEST(LightLaw, BareGroundHasTheHueOfItsToneWhereLightRulesHue) {
  const LightLaw light = fit_light_law(two_classes(true));
  EXPECT_EQ(light.by_tone(rock), 1.0);
  EXPECT_EQ(light.by_tone(pasture), 0.0);
  for (std::size_t k = 0; k < 4; ++k)  // lightness is uniform from 0.3 to 0.8
    EXPECT_NEAR(light.tone_lightness[k], 0.3 + 0.5 * ramp_quantiles[k], 0.012);
  EXPECT_EQ(fit_light_law(two_classes(false)).by_tone(rock), 0.0);
}

TEST(LightLaw, WaterDoesNotFollowIt) {
  const LightLaw none = law_of(water, fit_light_law(two_classes(true)));
  EXPECT_EQ(none.at(0.3), none.at(0.8));
  EXPECT_EQ(none.mix(), 0.0);
}

TEST(MoveLightness, TurnsHueAsThePaintingDoes) {
  const LightLaw law = fit_light_law(two_classes(true));
  LabRamp ramp{};
  for (std::size_t k = 0; k < 4; ++k) ramp[k] = {0.45 + 0.05 * static_cast<double>(k), 0.05, 0.05};
  const LabRamp out = move_lightness(ramp, {0.55, 0.6, 0.65, 0.7}, law);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(out[k].x, ramp[k].x + 0.1, 1e-12);
    EXPECT_NEAR(out[k].y, 0.05 + law.at(out[k].x).x - law.at(ramp[k].x).x, 1e-12);
    EXPECT_NEAR(out[k].z, 0.05, 0.01);
  }
}

TEST(KeepChroma, NeverFallsUnderThreeQuarters) {
  LabRamp before{};
  LabRamp after{};
  for (std::size_t k = 0; k < 4; ++k) {
    before[k] = {0.5, 0.10, 0.0};
    after[k] = {0.5, 0.05, 0.0};
  }
  after[3] = {0.5, 0.2, 0.0};
  const LabRamp out = keep_chroma(after, before);
  EXPECT_NEAR(chroma(out[0]), 0.075, 1e-12);
  EXPECT_NEAR(chroma(out[3]), 0.2, 1e-12);
}

}  // namespace
}  // namespace belvedere
