#include <gtest/gtest.h>

#include <cmath>

#include "renderer/style/paint_style.h"
#include "renderer/style/style_strokes.h"
#include "tests/renderer/style/styled_sheet.h"

namespace belvedere {
namespace {

constexpr PixelRect contour_sheet{0, 0, test::sheet_width, test::sheet_height};

struct Contoured {
  test::StyledSheet sheet = test::make_styled_sheet();
  Style style = test::make_style();
  StylePaintParameters parameters = test::make_style_parameters();
  StyleGround ground =
      prepare_style(style, sheet.guidance, sheet.render, {}, parameters, {0, 0}, contour_sheet);
  StyleWindow window{sheet.guidance, ground, {0, 0}};
};

TEST(PlaceContours, LinesRunAlongSilhouettesOnTheNearerSide) {
  Contoured of;
  of.parameters.contour_lines = 1.0;
  const std::vector<StyleStroke> lines =
      place_contour_strokes(of.style, of.window, of.parameters, contour_sheet);
  ASSERT_GT(lines.size(), 100U);
  // Silhouettes of the sheet: ground against sky, and the slope against the distant range.
  int against_sky = 0;
  for (const StyleStroke& line : lines) {
    ASSERT_TRUE(line.pixel_px.y == test::sky_end || line.pixel_px.y == 110) << line.pixel_px.y;
    against_sky += line.pixel_px.y == test::sky_end ? 1 : 0;
    const bool beside_edge = line.pixel_px.x < 20 || line.pixel_px.x >= test::sheet_width - 20;
    for (int k = 0; k < line.count && !beside_edge; ++k)
      ASSERT_NEAR(line.points[static_cast<std::size_t>(k)].y, 0.5, 1e-4);
    ASSERT_LT(line.colour.x, line.ground.x);
  }
  EXPECT_GT(against_sky, 40);
  EXPECT_LT(against_sky, static_cast<int>(lines.size()) - 40);
}

TEST(PlaceContours, DarkenTheNearerSideAlone) {
  Contoured of;
  const auto row_light = [&](int y) {
    const StyleCanvas canvas = paint_style_strokes(of.style, of.window, of.parameters,
                                                   {20, y, test::sheet_width - 20, y + 1});
    double sum = 0.0;
    for (std::size_t i = 0; i < canvas.colour.size(); ++i) sum += canvas.colour[i].x;
    return sum / static_cast<double>(canvas.colour.size());
  };
  const double near_before = row_light(110);
  const double far_before = row_light(109);
  of.parameters.contour_lines = 1.0;
  EXPECT_LT(row_light(110), near_before - 0.05);
  EXPECT_EQ(row_light(109), far_before);
}

TEST(PlaceContours, NoneWithoutASilhouette) {
  Contoured of;
  of.parameters.contour_lines = 1.0;
  of.sheet.guidance.depth_m = Grid<float>(test::sheet_width, test::sheet_height, 5000.0F);
  EXPECT_TRUE(place_contour_strokes(of.style, of.window, of.parameters, contour_sheet).empty());
}

}  // namespace
}  // namespace belvedere
