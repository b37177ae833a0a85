#include "renderer/style/paint_style.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "tests/grids.h"
#include "tests/renderer/style/styled_sheet.h"

namespace belvedere {
namespace {

constexpr PixelRect whole{0, 0, test::sheet_width, test::sheet_height};

Grid<glm::vec3> paint(const test::StyledSheet& sheet, const Style& style,
                      const StylePaintParameters& parameters, glm::ivec2 origin_px,
                      PixelRect wanted) {
  return paint_style(style, sheet.guidance, sheet.render, {}, parameters, origin_px, wanted);
}

// The result for a rectangle from a window that extends it by `margin`.
Grid<glm::vec3> paint_part(const test::StyledSheet& sheet, const Style& style,
                           const StylePaintParameters& parameters, PixelRect rect, int margin) {
  const PixelRect window = intersection(whole, grown(rect, margin));
  return paint(test::cut(sheet, window), style, parameters, {window.x0, window.y0},
               moved(rect, -window.x0, -window.y0));
}

int differing(const Grid<glm::vec3>& a, const Grid<glm::vec3>& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i] ? 1 : 0;
  return count;
}

class PaintStyle : public testing::Test {
 protected:
  const test::StyledSheet sheet = test::make_styled_sheet();
  Style style = test::make_style();
  StylePaintParameters parameters = test::make_style_parameters();
};

TEST_F(PaintStyle, AnyRectangleEqualsTheWhole) {
  parameters.pixels_per_unit = 0.6;
  parameters.contour_lines = 1.0;
  const Grid<glm::vec3> all = paint(sheet, style, parameters, {0, 0}, whole);
  const int margin = style_margin_px(style, parameters);
  ASSERT_LT(margin, 110);
  for (const PixelRect rect :
       {PixelRect{140, 40, 171, 80}, PixelRect{170, 140, 190, 160}, PixelRect{290, 250, 300, 260}})
    EXPECT_EQ(differing(paint_part(sheet, style, parameters, rect, margin), part_of(all, rect)), 0)
        << "at " << rect.x0 << " " << rect.y0;
}

// Swirls are in the test above; cumulus clouds, whose forms turn the strokes, here.
TEST_F(PaintStyle, AnyRectangleOfCumulusCloudsEqualsTheWhole) {
  style.brushwork[static_cast<std::size_t>(LandCoverClass::sky)].level = 0.8;
  style.sky.upper_edges = 0.35;
  style.sky.clear = glm::vec3(-0.08F, 0.0F, -0.05F);
  style.sky.clear_share = 0.3;
  style.sky.changes.front().streaks = {0.3, 0.3, 0.3};
  const Grid<glm::vec3> all = paint(sheet, style, parameters, {0, 0}, whole);
  const int margin = style_margin_px(style, parameters);
  const PixelRect rect{130, 5, 170, 45};
  EXPECT_EQ(differing(paint_part(sheet, style, parameters, rect, margin), part_of(all, rect)), 0);
}

TEST_F(PaintStyle, AQuarterOfTheMarginIsTooLittle) {
  const Grid<glm::vec3> all = paint(sheet, style, parameters, {0, 0}, whole);
  const PixelRect rect{140, 90, 171, 130};
  const int margin = style_margin_px(style, parameters) / 4;
  EXPECT_GT(differing(paint_part(sheet, style, parameters, rect, margin), part_of(all, rect)), 0);
}

TEST_F(PaintStyle, ThreadsChangeNothing) {
  const Grid<glm::vec3> many = paint(sheet, style, parameters, {0, 0}, whole);
  const ThreadLimit limit(1);
  EXPECT_EQ(differing(paint(sheet, style, parameters, {0, 0}, whole), many), 0);
}

TEST_F(PaintStyle, WithoutSharesTheRenderStays) {
  parameters.brushwork = 0.0;
  parameters.sky = 0.0;
  parameters.palette = 0.0;
  parameters.form_contrast = 1.0;
  parameters.unevenness = 0.0;
  const Grid<glm::vec3> out = paint(sheet, style, parameters, {0, 0}, whole);
  for (std::size_t i = 0; i < out.size(); ++i)
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(out[i][c], sheet.render[i][c], 2e-4);
}

TEST_F(PaintStyle, SeedsPaintOtherStrokes) {
  const Grid<glm::vec3> one = paint(sheet, style, parameters, {0, 0}, whole);
  parameters.seed = 12;
  EXPECT_GT(differing(paint(sheet, style, parameters, {0, 0}, whole), one),
            static_cast<int>(one.size()) / 2);
}

TEST_F(PaintStyle, MistKeepsTheRendersSky) {
  const Grid<float> veil(test::sheet_width, test::sheet_height, 1.0F);
  const StyleGround ground =
      prepare_style(style, sheet.guidance, sheet.render, veil, parameters, {0, 0}, whole);
  EXPECT_LT(glm::length(ground.colour(150, 20) - glm::vec3(to_oklab(sheet.render(150, 20)))),
            1e-6F);
}

constexpr PixelRect finished_rect{0, 0, 60, 60};

struct Finish {
  GuidanceBuffers guidance;
  StyleGround ground;
  StyleCanvas canvas;
  StylePaintParameters parameters = test::make_style_parameters(60, 60);
  Style style;

  Finish() {
    guidance.depth_m = Grid<float>(60, 60, 1000.0F);
    guidance.land_cover = Grid<LandCoverClass>(60, 60, LandCoverClass::pasture);
    ground.colour = Grid<glm::vec3>(60, 60, glm::vec3(0.5F, 0.0F, 0.0F));
    canvas.colour = ground.colour;
    canvas.height = Grid<float>(60, 60, 0.4F);
    parameters.weave = 0.0;
  }
  float light(int x, int y) const {
    const Grid<glm::vec3> out = finish_style(style, {guidance, ground, {0, 0}}, canvas,
                                             finished_rect, parameters, finished_rect);
    return static_cast<float>(to_oklab(out(x, y)).x);
  }
};

TEST(StyleFinish, AnEvenCanvasStays) { EXPECT_NEAR(Finish().light(30, 30), 0.5, 1e-4); }

TEST(StyleFinish, HalfOfTheFineDetailComesBack) {
  Finish finish;
  finish.ground.colour(30, 30).x = 0.3F;  // a dark dot that strokes have covered
  EXPECT_NEAR(finish.light(30, 30), 0.4, 0.01);
  EXPECT_NEAR(finish.light(50, 50), 0.5, 1e-4);
}

TEST(StyleFinish, RidgesAreLitFromTheUpperLeft) {
  Finish finish;
  for (const auto [x, y] : test::cells({25, 0, 35, 60})) finish.canvas.height(x, y) = 0.9F;
  EXPECT_GT(finish.light(24, 30), 0.51F);
  EXPECT_LT(finish.light(35, 30), 0.49F);
}

TEST(StyleFinish, WeaveHasItsDeviation) {
  Finish finish;
  finish.parameters.weave = 0.02;
  const Grid<glm::vec3> out =
      finish_style(finish.style, {finish.guidance, finish.ground, {0, 0}}, finish.canvas,
                   finished_rect, finish.parameters, finished_rect);
  double squares = 0.0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double apart = to_oklab(out[i]).x - 0.5;
    squares += apart * apart;
  }
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(out.size())), 0.02 / std::sqrt(2.0), 0.003);
}

TEST(StyleFinish, NoShareOfBrushworkLeavesTheGround) {
  Finish finish;
  finish.canvas.colour = Grid<glm::vec3>(60, 60, glm::vec3(0.8F, 0.0F, 0.0F));
  finish.parameters.brushwork = 0.0;
  EXPECT_NEAR(finish.light(30, 30), 0.5, 1e-4);
}

}  // namespace
}  // namespace belvedere
