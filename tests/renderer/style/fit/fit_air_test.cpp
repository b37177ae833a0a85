#include "renderer/style/fit/fit_air.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/renderer/style/synthetic_painting.h"

namespace belvedere {
namespace {

using enum LandCoverClass;

Grid<glm::vec3> encoded(const Grid<glm::vec3>& lab) {
  Grid<glm::vec3> out(lab.width(), lab.height());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = glm::clamp(from_oklab(lab[i]), 0.0F, 1.0F);
  return out;
}

// A picture of rock only, coloured by f.
template <class F>
StylePainting all_rock(int width, int height, F f) {
  Grid<glm::vec3> lab(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) lab(x, y) = f(x, y);
  return prepare_painting(encoded(lab), Grid<std::uint8_t>(width, height, test::label_of(rock)));
}

TEST(MeasurePaint, TrendIsTheChangeFromFootToTop) {
  const PaintFigures figures = measure_paint(all_rock(120, 100, [](int, int y) {
    const float up = 1.0F - static_cast<float>(y) / 99.0F;
    return glm::vec3(0.5F + 0.1F * up, 0.02F, 0.04F - 0.03F * up);
  }));
  EXPECT_NEAR(figures.trend.x, 0.10, 0.003);
  EXPECT_NEAR(figures.trend.y, 0.0, 0.003);
  EXPECT_NEAR(figures.trend.z, -0.03, 0.003);
}

TEST(MeasurePaint, TrendKeepsWithinItsLimits) {
  const PaintFigures figures = measure_paint(all_rock(120, 100, [](int, int y) {
    return glm::vec3(0.9F - 0.006F * static_cast<float>(y), 0.0F, 0.0F);
  }));
  EXPECT_EQ(figures.trend.x, 0.16);
}

// Waves of 200 px and grain of one pixel, no sizes between: broken paint is the ratio of the grain
// that a blur of 1.5 px removes to the waves that one of 24 px leaves; vapour is 1.
TEST(MeasurePaint, BrokenPaintAndVapourAreRatiosOfSpreads) {
  constexpr double pi = std::numbers::pi;
  const auto painting = [](double grain, double middle) {
    return measure_paint(all_rock(400, 120, [&](int x, int y) {
      const double large = 0.10 * std::cos(2.0 * pi * (x + 0.5) / 200.0);
      const double fine = grain * random_normal(2, x, y);
      const double form = middle == 0.0 ? 0.0 : middle * gaussian_noise(3, x, y, 4.0);
      return glm::vec3(0.5 + large + fine + form, 0.0, 0.0);
    }));
  };
  const PaintFigures smooth = painting(0.0, 0.0);
  EXPECT_LT(smooth.broken, 0.02);
  EXPECT_EQ(smooth.vapour, 1.0);
  const double waves = 0.10 / std::sqrt(2.0) * std::exp(-2.0 * pi * pi * 24.0 * 24.0 / 40000.0);
  // Variance of white noise less its blur: 1 - 2 / (2π s²) + 1 / (4π s²).
  const double grain = 0.04 * std::sqrt(1.0 - 0.75 / (pi * 1.5 * 1.5));
  EXPECT_NEAR(painting(0.04, 0.0).broken, grain / waves, 0.05 * grain / waves);
  const PaintFigures formed = painting(0.0, 0.08);
  EXPECT_EQ(formed.vapour, 0.0);
  EXPECT_GT(formed.form_deviation, 2.0 * smooth.form_deviation);
}

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
