#include "renderer/style/style_sky.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/renderer/style/styled_sheet.h"

namespace belvedere {
namespace {

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
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 3; ++x) style.sky.medians(x, y) = glm::vec3(0.9F - 0.1F * y, 0.0F, 0.0F);
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

}  // namespace
}  // namespace belvedere
