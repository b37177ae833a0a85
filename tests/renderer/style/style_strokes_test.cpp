#include "renderer/style/style_strokes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/style/paint_style.h"
#include "tests/grids.h"
#include "tests/renderer/style/styled_sheet.h"

namespace belvedere {
namespace {

constexpr PixelRect every_pixel{0, 0, test::sheet_width, test::sheet_height};

StyleCanvas canvas_of(const test::StyledSheet& sheet, const Style& style,
                      const StylePaintParameters& parameters) {
  const StyleGround ground =
      prepare_style(style, sheet.guidance, sheet.render, {}, parameters, {0, 0}, every_pixel);
  return paint_style_strokes(style, {sheet.guidance, ground, {0, 0}}, parameters, every_pixel);
}

// One exact colour for each class.
test::StyledSheet flat_sheet() {
  test::StyledSheet sheet = test::make_styled_sheet();
  for (std::size_t i = 0; i < sheet.render.size(); ++i)
    sheet.render[i] = sheet.guidance.is_sky(i) ? glm::vec3(0.6F, 0.7F, 0.9F)
                      : sheet.guidance.land_cover[i] == LandCoverClass::water
                          ? glm::vec3(0.2F, 0.3F, 0.5F)
                          : glm::vec3(0.4F, 0.5F, 0.3F);
  return sheet;
}

// Nothing changes the ground before strokes.
Style bare_style() {
  Style style = test::make_style();
  style.vapour = 0.0;
  style.trend = glm::vec3(0.0F);
  style.sky = {};
  return style;
}

TEST(StyleStrokes, NoneCrossesTheBordersOfSkyAndWater) {
  test::StyledSheet sheet = flat_sheet();
  // The same colour everywhere, so that the colour gate ends no stroke.
  sheet.render = Grid<glm::vec3>(test::sheet_width, test::sheet_height, glm::vec3(0.5F));
  Style style = bare_style();
  for (StyleBrushwork& b : style.brushwork) {
    b.residuals = {};
    b.accents.clear();
  }
  const auto paint_only = [&](LandCoverClass id) {
    Style one = style;
    for (auto& part : one.brushwork[static_cast<std::size_t>(id)].residuals)
      part = {glm::vec3(0.2F, 0.0F, 0.0F)};
    return canvas_of(sheet, one, test::make_style_parameters()).colour;
  };
  const auto grey = static_cast<float>(to_oklab(glm::vec3(0.5F)).x);
  for (const LandCoverClass id : {LandCoverClass::sky, LandCoverClass::water}) {
    const Grid<glm::vec3> painted = paint_only(id);
    int lighter = 0;
    for (std::size_t i = 0; i < painted.size(); ++i) {
      const bool own = sheet.guidance.land_cover[i] == id;
      ASSERT_TRUE(own || std::abs(painted[i].x - grey) < 0.011F);
      lighter += own && painted[i].x > grey + 0.03F ? 1 : 0;
    }
    EXPECT_GT(lighter, 1000);
  }
}

TEST(StyleStrokes, WithoutResidualsTheColourStays) {
  const test::StyledSheet sheet = flat_sheet();
  Style style = bare_style();
  for (StyleBrushwork& b : style.brushwork) {
    b.residuals = {};
    b.accents.clear();
  }
  StylePaintParameters parameters = test::make_style_parameters();
  parameters.form_contrast = 1.0;
  parameters.unevenness = 0.0;
  const Grid<glm::vec3> painted = canvas_of(sheet, style, parameters).colour;
  for (std::size_t i = 0; i < painted.size(); ++i) {
    const glm::vec3 before(to_oklab(sheet.render[i]));
    ASSERT_NEAR(painted[i].x, before.x, 0.012F);  // hairs alone
    ASSERT_NEAR(painted[i].y, before.y, 1e-3F);
  }
}

TEST(StyleStrokes, CoverNearlyEverything) {
  const test::StyledSheet sheet = flat_sheet();
  const StyleCanvas canvas = canvas_of(sheet, bare_style(), test::make_style_parameters());
  int bare = 0;
  for (std::size_t i = 0; i < canvas.height.size(); ++i) bare += canvas.height[i] == 0.4F ? 1 : 0;
  EXPECT_LT(bare, static_cast<int>(canvas.height.size()) / 30);
}

TEST(StyleStrokes, StopWhereTheGroundChangesColour) {
  test::StyledSheet sheet = flat_sheet();
  // Black and white meadow: a border of colour within one class.
  for (const auto [x, y] : test::cells({130, 110, test::sheet_width, test::sheet_height}))
    if (sheet.guidance.land_cover(x, y) == LandCoverClass::pasture)
      sheet.render(x, y) = glm::vec3(x < 160 ? 0.1F : 0.9F);
  StylePaintParameters parameters = test::make_style_parameters();
  parameters.form_contrast = 1.0;
  parameters.unevenness = 0.0;
  const Grid<glm::vec3> painted = canvas_of(sheet, bare_style(), parameters).colour;
  for (int y = 130; y < 250; ++y) {
    ASSERT_LT(painted(158, y).x, 0.5F);
    ASSERT_GT(painted(161, y).x, 0.7F);
  }
}

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
