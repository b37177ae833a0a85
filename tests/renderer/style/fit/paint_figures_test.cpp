#include "renderer/style/fit/paint_figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "tests/grids.h"
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
  for (const auto [x, y] : test::cells(width, height)) lab(x, y) = f(x, y);
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

// Panels of two flat colours with and without dark lines between them.
TEST(MeasurePaint, ContourLinesAreDarkerThanBothSides) {
  const auto panels = [](float line) {
    return measure_paint(all_rock(400, 200, [line](int x, int) {
      const int in = x % 50;
      const float flat = x / 50 % 2 == 0 ? 0.45F : 0.65F;
      return glm::vec3(in < 2 || in >= 48 ? line : flat, 0.0F, 0.02F);
    }));
  };
  EXPECT_EQ(panels(0.20F).contour_lines, 1.0);
  const PaintFigures plain = measure_paint(all_rock(400, 200, [](int x, int) {
    return glm::vec3(x / 50 % 2 == 0 ? 0.45F : 0.65F, 0.0F, 0.02F);
  }));
  EXPECT_EQ(plain.contour_lines, 0.0);
  EXPECT_EQ(panels(0.90F).contour_lines, 0.0) << "light lines are no contours";
}

// Grain of one strength everywhere, and of four times the strength on half of the picture: log2 of
// the contrast differs by 2 between equal halves, a deviation of 1.
TEST(MeasurePaint, UnevennessIsTheDeviationOfLogContrast) {
  const auto grain = [](double right) {
    return measure_paint(all_rock(512, 256, [right](int x, int y) {
      const double strength = x < 256 ? 0.02 : right;
      return glm::vec3(static_cast<float>(0.5 + strength * random_normal(5, x, y)), 0.0F, 0.0F);
    }));
  };
  EXPECT_LT(grain(0.02).unevenness, 0.1);
  EXPECT_NEAR(grain(0.08).unevenness, 1.0, 0.08);
}

}  // namespace
}  // namespace belvedere
