#include "renderer/style/style_ground.h"

#include <gtest/gtest.h>

#include "tests/renderer/style/styled_sheet.h"

namespace belvedere {
namespace {

StylePaintParameters plain_parameters() {
  StylePaintParameters parameters = test::make_style_parameters();
  parameters.form_contrast = 1.0;
  parameters.unevenness = 0.0;
  return parameters;
}

StyleGround ground_of(const test::StyledSheet& sheet, const Style& style,
                      const StylePaintParameters& parameters) {
  return make_style_ground(style, sheet.guidance, sheet.render, {}, parameters, {0, 0});
}

TEST(StyleGround, DistanceRunsFromNearToFarByItsLogarithm) {
  StylePaintParameters parameters;
  parameters.near_m = 1000.0;
  parameters.far_m = 100000.0;
  EXPECT_EQ(style_distance(parameters, 10.0), 0.0);
  EXPECT_NEAR(style_distance(parameters, 10000.0), 0.5, 1e-12);
  EXPECT_EQ(style_distance(parameters, 1e9), 1.0);
}

TEST(StyleGround, TrendLightensWhatIsFar) {
  const test::StyledSheet sheet = test::make_styled_sheet();
  Style style = test::make_style();
  style.vapour = 0.0;
  style.trend = glm::vec3(0.1F, 0.0F, 0.0F);
  StylePaintParameters parameters = plain_parameters();
  parameters.near_m = 20000.0;
  parameters.far_m = 40000.0;
  const StyleGround ground = ground_of(sheet, style, parameters);
  const auto more = [&](int x, int y) {
    return ground.colour(x, y).x - static_cast<float>(to_oklab(sheet.render(x, y)).x);
  };
  EXPECT_NEAR(more(150, 80), 0.03, 1e-4);
  EXPECT_NEAR(more(150, 220), -0.03, 1e-4);
}

TEST(StyleGround, VapourDrawsFarGroundTowardsTheAir) {
  const test::StyledSheet sheet = test::make_styled_sheet();
  Style style = test::make_style();
  style.trend = glm::vec3(0.0F);
  style.palette.sky = {{1.0, style.palette.haze_far}};
  style.vapour = 1.0;
  StylePaintParameters parameters = plain_parameters();
  parameters.far_m = 50000.0;
  const StyleGround ground = ground_of(sheet, style, parameters);
  const glm::vec3 air(to_oklab(style.palette.haze_far));
  const auto apart = [&](const glm::vec3& lab) { return glm::length(lab - air); };
  const float before = apart(glm::vec3(to_oklab(sheet.render(150, 80))));
  EXPECT_LT(apart(ground.colour(150, 80)), 0.85F * before);
}

TEST(StyleGround, FormContrastKeepsAnEvenColour) {
  test::StyledSheet sheet = test::make_styled_sheet();
  sheet.render = Grid<glm::vec3>(test::sheet_width, test::sheet_height, glm::vec3(0.4F));
  Style style = test::make_style();
  style.vapour = 0.0;
  style.trend = glm::vec3(0.0F);
  StylePaintParameters parameters = test::make_style_parameters();
  parameters.form_contrast = 1.4;
  const StyleGround ground = ground_of(sheet, style, parameters);
  const auto grey = static_cast<float>(to_oklab(glm::vec3(0.4F)).x);
  for (int y = test::sky_end; y < test::sheet_height; ++y) {
    ASSERT_NEAR(ground.colour(100, y).x, grey, 2e-5);
    ASSERT_NEAR(ground.smoothed(100, y).x, grey, 0.02) << y;
  }
}

TEST(StyleGround, CalmLosesGrainAndKeepsBorders) {
  const test::StyledSheet sheet = test::make_styled_sheet();
  Style style = test::make_style();
  style.vapour = 0.0;
  const StyleGround ground = ground_of(sheet, style, plain_parameters());
  const auto grain = [](const Grid<glm::vec3>& lab) {
    double sum = 0.0;
    for (int y = 205; y < 255; ++y)
      for (int x = 140; x < 290; ++x) sum += std::abs(lab(x + 1, y).x - lab(x, y).x);
    return sum;
  };
  EXPECT_LT(grain(ground.smoothed), 0.5 * grain(ground.colour));
  // The shore of the lake: water is bluer.
  EXPECT_GT(ground.smoothed(178, 175).z - ground.smoothed(183, 175).z, 0.08F);
}

}  // namespace
}  // namespace belvedere
