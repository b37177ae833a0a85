#include "renderer/style/style_ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/filter.h"
#include "tests/grids.h"
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
  const StylePaintParameters parameters{.near_m = 1000.0, .far_m = 100000.0};
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
    for (const auto [x, y] : test::cells({140, 205, 290, 255}))
      sum += std::abs(lab(x + 1, y).x - lab(x, y).x);
    return sum;
  };
  EXPECT_LT(grain(ground.smoothed), 0.5 * grain(ground.colour));
  // The shore of the lake: water is bluer.
  EXPECT_GT(ground.smoothed(178, 175).z - ground.smoothed(183, 175).z, 0.08F);
}

TEST(StyleSky, AmountsFollowTheQuantiles) {
  StyleSkyChange change;
  change.quantiles = {-3.0, -1.0, -0.5, 0.2, 0.5, 1.0, 4.0};
  EXPECT_EQ(shaped_amount(change, 0.0), 0.2);
  EXPECT_EQ(shaped_amount(change, -9.0), -3.0);
  EXPECT_EQ(shaped_amount(change, 9.0), 4.0);
  EXPECT_NEAR(shaped_amount(change, 0.337), 0.35, 1e-9);
}

TEST(StyleSky, OneColourStaysAndGroundIsLeftAlone) {
  const test::StyledSheet sheet = test::make_styled_sheet();
  Style style = test::make_style();
  style.sky.changes.clear();
  Grid<glm::vec3> lab(test::sheet_width, test::sheet_height, glm::vec3(0.1F));
  paint_style_sky(lab, style, sheet.guidance, test::make_style_parameters(), {0, 0});
  for (int y = 0; y < test::sheet_height; ++y)
    ASSERT_LT(glm::length(lab(150, y) -
                          (y < test::sky_end ? glm::vec3(0.75F, 0.0F, -0.05F) : glm::vec3(0.1F))),
              1e-5F)
        << y;
}

TEST(StyleSky, RowsOfMediansLieFromTheTopToTheHorizon) {
  const test::StyledSheet sheet = test::make_styled_sheet();
  Style style = test::make_style();
  style.sky.changes.clear();
  for (const auto [x, y] : test::cells(3, 5))
    style.sky.medians(x, y) = glm::vec3(0.9F - 0.1F * y, 0.0F, 0.0F);
  Grid<glm::vec3> lab(test::sheet_width, test::sheet_height, glm::vec3(0.0F));
  paint_style_sky(lab, style, sheet.guidance, test::make_style_parameters(), {0, 0});
  EXPECT_NEAR(lab(10, 0).x, 0.9, 0.02);
  EXPECT_NEAR(lab(10, 24).x, 0.7, 0.02);  // the middle row of five over four fifths of 60 rows
  EXPECT_NEAR(lab(10, 58).x, 0.5, 0.02);
}

TEST(StyleSky, ChangesHaveTheirDeviationOnAWideSky) {
  GuidanceBuffers guidance;
  guidance.depth_m = Grid<float>(500, 300, std::numeric_limits<float>::infinity());
  Style style = test::make_style();
  style.sky.changes[0].length_x = 0.02;
  style.sky.changes[0].length_y = 0.02;
  StylePaintParameters parameters = test::make_style_parameters(500, 300);
  parameters.sky_rows = 300;
  Grid<glm::vec3> lab(500, 300, glm::vec3(0.0F));
  paint_style_sky(lab, style, guidance, parameters, {0, 0});
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < lab.size(); ++i) {
    sum += lab[i].x;
    squares += static_cast<double>(lab[i].x) * lab[i].x;
  }
  const double mean = sum / static_cast<double>(lab.size());
  EXPECT_NEAR(mean, 0.75, 0.01);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(lab.size()) - mean * mean), 0.04, 0.008);
}

// Deviation of lightness between Gaussians of 1 and 2 times a sigma.
double band_deviation(const Grid<glm::vec3>& lab, double sigma) {
  Grid<float> light(lab.width(), lab.height());
  for (std::size_t i = 0; i < lab.size(); ++i) light[i] = lab[i].x;
  const Grid<float> fine = gaussian_blur(light, sigma);
  const Grid<float> coarse = gaussian_blur(light, 2.0 * sigma);
  double squares = 0.0;
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const double off = static_cast<double>(fine[i]) - static_cast<double>(coarse[i]);
    squares += off * off;
  }
  return std::sqrt(squares / static_cast<double>(fine.size()));
}

struct WideSky {
  GuidanceBuffers guidance;
  Grid<glm::vec3> lab{600, 300, glm::vec3(0.0F)};
  StylePaintParameters parameters = test::make_style_parameters(600, 300);
  WideSky() {
    guidance.depth_m = Grid<float>(600, 300, std::numeric_limits<float>::infinity());
    parameters.sky_rows = 300;
  }
};

TEST(StyleSky, StreaksHaveTheirDeviations) {
  Style style = test::make_style();
  style.sky.changes[0].length_x = 0.3;
  style.sky.changes[0].length_y = 0.3;
  const double sigma = std::sqrt(600.0 * 300.0) / 90.0;
  WideSky smooth;
  paint_style_sky(smooth.lab, style, smooth.guidance, smooth.parameters, {0, 0});
  EXPECT_LT(band_deviation(smooth.lab, sigma), 0.1 * 0.04);
  style.sky.changes[0].streaks = {0.2, 0.2, 0.2};
  WideSky streaky;
  paint_style_sky(streaky.lab, style, streaky.guidance, streaky.parameters, {0, 0});
  for (const double scale : {1.0, 2.0, 4.0})
    EXPECT_NEAR(band_deviation(streaky.lab, scale * sigma), 0.2 * 0.04, 0.2 * 0.04 * 0.35) << scale;
}

TEST(StyleSky, CumulusLeaveTheClearSkyBetweenThem) {
  Style style = test::make_style();
  style.sky.changes[0].axis = glm::vec3(0.001F, 0.0F, 0.0F);
  style.sky.upper_edges = 0.35;
  style.sky.clear = glm::vec3(-0.1F, 0.0F, -0.05F);
  style.sky.clear_share = 0.25;
  WideSky sky;
  paint_style_sky(sky.lab, style, sky.guidance, sky.parameters, {0, 0});
  int clear = 0;
  for (int y = 0; y < 150; ++y)  // the upper half, where all clouds are cumulus
    for (int x = 0; x < 600; ++x) clear += sky.lab(x, y).x < 0.70F ? 1 : 0;
  EXPECT_NEAR(clear / (600.0 * 150.0), 0.25, 0.12);
  EXPECT_GT(sky.lab(300, 299).x, 0.74F);  // none at the horizon
}

}  // namespace
}  // namespace belvedere
