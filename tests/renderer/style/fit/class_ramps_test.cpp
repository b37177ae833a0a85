#include "renderer/style/fit/class_ramps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/grids.h"
#include "tests/renderer/style/synthetic_painting.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

// Lightness uniform from .3 to .8; hue of constant chroma that rotates with it.
std::vector<glm::vec3> ramp_texels() {
  std::vector<glm::vec3> texels;
  for (int i = 0; i < 5000; ++i) {
    const double share = (i * 1237 % 5000) / 5000.0;
    const double hue = 1.0 + 0.4 * share;
    texels.emplace_back(0.3 + 0.5 * share, 0.08 * std::cos(hue), 0.08 * std::sin(hue));
  }
  return texels;
}

TEST(QuantileRamp, GivesBackTheColoursAtItsQuantiles) {
  const LabRamp ramp = quantile_ramp(ramp_texels());
  for (std::size_t k = 0; k < 4; ++k) {
    const double q = ramp_quantiles[k];
    EXPECT_NEAR(ramp[k].x, 0.3 + 0.5 * q, 2e-3) << k;
    // Hue is the mean over the neighbouring ranks that exist.
    const double middle = 0.5 * (std::max(0.0, q - 0.1) + std::min(1.0, q + 0.1));
    EXPECT_NEAR(ramp[k].y, 0.08 * std::cos(1.0 + 0.4 * middle), 2e-3) << k;
    EXPECT_NEAR(ramp[k].z, 0.08 * std::sin(1.0 + 0.4 * middle), 2e-3) << k;
  }
}

// Half of it is grey, half of it red: it looks red, but the median is nearly grey.
TEST(QuantileRamp, ColourCountsMoreThanGrey) {
  std::vector<glm::vec3> texels;
  for (int i = 0; i < 1000; ++i)
    texels.emplace_back(0.4 + 0.0002 * i, i % 2 == 0 ? 0.10 : 0.005, 0.0);
  EXPECT_GT(quantile_ramp(texels)[2].y, 0.09);
}

TEST(QuantileRamp, OneColourIsEnough) {
  const LabRamp ramp = quantile_ramp({glm::vec3(0.5F, 0.1F, 0.0F)});
  for (const glm::dvec3& colour : ramp) EXPECT_NEAR(colour.x, 0.5, 1e-6);
}

LabRamp grey_ramp(std::array<double, 4> lightness) {
  LabRamp ramp{};
  for (std::size_t k = 0; k < 4; ++k) ramp[k] = {lightness[k], 0.02, 0.03};
  return ramp;
}

TEST(StretchRamp, HasTheRangeOfTheReferenceMostlyInShade) {
  const LabRamp reference = grey_ramp({0.2, 0.4, 0.6, 0.8});
  const LabRamp ramp = grey_ramp({0.5, 0.55, 0.6, 0.7});
  const LabRamp out = stretch_ramp(ramp, reference, {0.05, 0.98}, LightLaw{});
  EXPECT_NEAR(out[3].x - out[0].x, 0.85 * 0.6, 1e-9);
  // The painting's light end plus .02 and a quarter of half of the added range.
  const double added = 0.85 * 0.6 - 0.2;
  EXPECT_NEAR(out[3].x, 0.7 + 0.02 + 0.25 * 0.5 * added, 1e-9);
  // A ramp with enough range is unchanged.
  const LabRamp same = stretch_ramp(reference, reference, {0.05, 0.98}, LightLaw{});
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(same[k].x, reference[k].x, 1e-9);
}

TEST(StretchRamp, StaysWithinTheLightnessOfThePainting) {
  const LabRamp out = stretch_ramp(grey_ramp({0.30, 0.32, 0.34, 0.36}),
                                   grey_ramp({0.1, 0.4, 0.6, 0.9}), {0.28, 0.37}, LightLaw{});
  EXPECT_GE(out[0].x, 0.28);
  EXPECT_LE(out[3].x, 0.37 + 1e-9);
}

TEST(FitClassRamps, SeesTheClassesOfTheMaskInTheirHues) {
  const test::Landscape landscape = test::make_landscape();
  const StylePainting painting = prepare_painting(landscape.picture, landscape.mask);
  const ClassRamps reference = palette_ramps(read_palette("summer"));
  const SeenRamps seen = fit_class_ramps(painting, fit_light_law(painting), reference);
  using enum LandCoverClass;
  for (const LandCoverClass id : {snow, rock, forest, pasture})
    EXPECT_TRUE(seen.seen[index_of(id)]);
  for (const LandCoverClass id : {sky, water, scree}) EXPECT_FALSE(seen.seen[index_of(id)]);
  const LabRamp& green = seen.ramps[index_of(pasture)];
  for (const glm::dvec3& colour : green) {
    EXPECT_LT(colour.y, -0.02);
    EXPECT_GT(colour.z, 0.03);
  }
  for (std::size_t k = 1; k < 4; ++k) EXPECT_GT(green[k].x, green[k - 1].x);
}

// A warm lake under a warm sky, and blue paint elsewhere: water takes most of the blue's hue.
TEST(FitClassRamps, WarmWaterIsCooled) {
  Grid<glm::vec3> picture(120, 90);
  Grid<std::uint8_t> mask(120, 90);
  for (const auto [x, y] : test::cells(120, 90)) {
    const bool lake = y < 30;
    const bool blue = y >= 55;
    mask(x, y) = blue ? std::uint8_t{255} : test::label_of(lake ? water : pasture);
    const double light = 0.45 + 0.2 * (x % 40) / 39.0;
    picture(x, y) = lake   ? from_oklab({light, 0.01, 0.04})
                    : blue ? from_oklab({light, -0.02, -0.07})
                           : from_oklab({light, 0.0, 0.09});
  }
  const StylePainting painting = prepare_painting(picture, mask);
  const SeenRamps seen =
      fit_class_ramps(painting, fit_light_law(painting), palette_ramps(read_palette("summer")));
  EXPECT_THAT(seen.notes, testing::ElementsAre(testing::HasSubstr("water is warm")));
  EXPECT_NEAR(seen.ramps[index_of(water)][1].z, 0.3 * 0.04 + 0.7 * -0.07, 0.012);
}

// All rock lies in blue shade, meadows in golden light: rock in light is golden too.
TEST(FitClassRamps, RockInLightHasTheHueOfLightWhereLightRulesHue) {
  Grid<glm::vec3> picture(120, 90);
  Grid<std::uint8_t> mask(120, 90);
  for (const auto [x, y] : test::cells(120, 90)) {
    const bool shade = y < 45;
    mask(x, y) = test::label_of(shade ? rock : pasture);
    const double light = (shade ? 0.40 : 0.65) + 0.2 * (x % 40) / 39.0;
    picture(x, y) = from_oklab({light, 0.01, shade ? -0.06 : 0.07});
  }
  const StylePainting painting = prepare_painting(picture, mask);
  const LightLaw law = fit_light_law(painting);
  ASSERT_EQ(law.by_tone(rock), 1.0);
  const LabRamp ramp =
      fit_class_ramps(painting, law, palette_ramps(read_palette("summer"))).ramps[index_of(rock)];
  EXPECT_LT(ramp[0].z, -0.03);
  EXPECT_GT(ramp[3].z, 0.03);
}

using enum LandCoverClass;

// Two classes of all lightnesses, in uniform rows of 6 px so that the blur within classes has
// little effect; `a` of a colour depends on its lightness, or on its class.
StylePainting two_classes(bool by_light) {
  Grid<glm::vec3> picture(128, 120);
  Grid<std::uint8_t> mask(128, 120);
  for (const auto [x, y] : test::cells(128, 120)) {
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
