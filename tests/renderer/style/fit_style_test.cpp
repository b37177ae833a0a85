#include "renderer/style/fit_style.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/style/style_file.h"
#include "tests/files.h"
#include "tests/grids.h"
#include "tests/renderer/style/synthetic_painting.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

Style fitted(const test::Landscape& landscape) {
  StyleFitParameters parameters;
  parameters.name = "bands";
  parameters.origin = "nobody";
  return fit_style(landscape.picture, landscape.mask, read_palette("summer"), parameters,
                   silent_progress());
}

std::string refusal(const Grid<glm::vec3>& picture, const Grid<std::uint8_t>& mask) {
  return std::string(test::error_of([&] {
                       fit_style(picture, mask, read_palette("summer"), {}, silent_progress());
                     }).what());
}

TEST(FitStyle, GivesAllThatASceneNeeds) {
  const Style style = fitted(test::make_landscape());
  EXPECT_EQ(style.name, "bands");
  EXPECT_EQ(style.palette.name, "bands");
  for (std::size_t c = 1; c < land_cover_class_count; ++c) {
    ASSERT_EQ(style.palette.classes[c].stops.size(), 1U);
    for (const glm::vec3& colour : style.palette.classes[c].stops[0].ramp)
      for (int k = 0; k < 3; ++k) {
        EXPECT_GE(colour[k], 0.0F);
        EXPECT_LE(colour[k], 1.0F);
      }
  }
  for (const LabRamp& ramp : palette_ramps(style.palette))
    for (std::size_t k = 1; k < 4; ++k) EXPECT_GE(ramp[k].x, ramp[k - 1].x);
  EXPECT_EQ(style.palette.sky.size(), 5U);
  EXPECT_EQ(style.sky.medians.width(), 3);
  EXPECT_GT(style.brushwork[0].length_px, 0.0);
  EXPECT_GT(style.brushwork[static_cast<std::size_t>(LandCoverClass::rock)].length_px, 0.0);
  EXPECT_EQ(style.brushwork[static_cast<std::size_t>(LandCoverClass::water)].length_px, 0.0);
  EXPECT_EQ(style.units_per_px, 2.6);  // a small painting is enlarged to the limit
  EXPECT_THAT(style.notes, Contains("classes seen: forest, rock, snow, pasture"));
  EXPECT_THAT(style.notes, Contains(HasSubstr("no far air")));
}

TEST(FitStyle, IsTheSameForAnyNumberOfThreads) {
  const test::Landscape landscape = test::make_landscape();
  const std::string text = style_text(fitted(landscape));
  const ThreadLimit one(1);
  EXPECT_EQ(style_text(fitted(landscape)), text);
}

// A painting at half the lightness gives ramps as light as a map needs; hues are unchanged.
TEST(FitStyle, DarkPaintingsAreCleaned) {
  test::Landscape dark = test::make_landscape();
  for (std::size_t i = 0; i < dark.picture.size(); ++i)
    dark.picture[i] = from_oklab(glm::dvec3(0.6F * dark.lab[i]));
  const Style style = fitted(dark);
  EXPECT_THAT(style.notes, Contains(HasSubstr("lightened")));
  EXPECT_GE(ground_lightness(palette_ramps(style.palette)), 0.55);
}

TEST(FitStyle, WithoutASkyThereIsAPlainOne) {
  test::Landscape landscape = test::make_landscape();
  for (std::uint8_t& label : landscape.mask)
    if (label == test::label_of(LandCoverClass::sky)) label = unused_label;
  const Style style = fitted(landscape);
  EXPECT_TRUE(style.sky.medians.empty());
  EXPECT_EQ(style.palette.sky.size(), 2U);
  EXPECT_THAT(style.notes, Contains(HasSubstr("no sky")));
  EXPECT_THAT(style.notes, Contains(HasSubstr("no water")));
}

TEST(FitStyle, RefusesMasksThatDoNotFit) {
  const test::Landscape landscape = test::make_landscape();
  EXPECT_THAT(refusal(landscape.picture, Grid<std::uint8_t>(10, 10, 4)),
              HasSubstr("the size of the painting"));
  Grid<std::uint8_t> strange = landscape.mask;
  strange(3, 3) = 77;
  EXPECT_THAT(refusal(landscape.picture, strange), HasSubstr("the number 77"));
  EXPECT_THAT(refusal(landscape.picture, Grid<std::uint8_t>(160, 120, 0)),
              HasSubstr("no class of the ground"));
}

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

using enum LandCoverClass;

TEST(FitAir, FarAirOfTheMaskGoesBeforeGuesses) {
  test::Landscape landscape = test::make_landscape();
  const StylePainting inferred = prepare_painting(landscape.picture, landscape.mask);
  const glm::dvec3 horizon(0.85, -0.01, -0.02);
  const StyleAir without = fit_air(inferred, horizon);
  EXPECT_FALSE(without.far_seen);
  EXPECT_NEAR(without.mist.y, 0.5 * (without.far.y + horizon.y), 1e-12);
  for (const auto [x, y] : test::cells({0, 24, landscape.mask.width(), 34})) {
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
