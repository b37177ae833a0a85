#include "renderer/style/style_finish.h"

#include <gtest/gtest.h>

#include "tests/renderer/style/styled_sheet.h"

namespace belvedere {
namespace {

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
  for (int y = 0; y < 60; ++y)
    for (int x = 25; x < 35; ++x) finish.canvas.height(x, y) = 0.9F;
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
