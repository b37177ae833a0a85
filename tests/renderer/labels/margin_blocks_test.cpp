#include "renderer/labels/margin_blocks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "base/pixel_rect.h"
#include "renderer/labels/sheet_painter.h"

namespace belvedere {
namespace {

constexpr glm::dvec2 box{60.0, 22.0};

// The extent of paint, with half of the line widths.
PixelRect reach(const std::vector<DrawnShape>& shapes) {
  glm::dvec2 low(std::numeric_limits<double>::infinity()), high(-low);
  for (const DrawnShape& shape : shapes)
    if (const DrawnPath* path = std::get_if<DrawnPath>(&shape))
      for (const glm::dvec2 p : path->points) {
        low = glm::min(low, p - .5 * path->width_px);
        high = glm::max(high, p + .5 * path->width_px);
      }
  return {static_cast<int>(std::floor(low.x)), static_cast<int>(std::floor(low.y)),
          static_cast<int>(std::ceil(high.x)), static_cast<int>(std::ceil(high.y))};
}

TEST(LegendSwatch, StaysInItsBoxHoweverBroadTheFeature) {
  for (const SwatchForm form : {SwatchForm::line, SwatchForm::cable, SwatchForm::house})
    for (const double width_mm : {.05, .6, 40.0}) {
      const std::vector<DrawnShape> shapes = draw_swatch({.name = "x",
                                                          .form = form,
                                                          .bed = "#ffffff",
                                                          .width_mm = width_mm,
                                                          .bed_mm = 2.0,
                                                          .has_pylons = true},
                                                         box, 3.0);
      EXPECT_EQ(reach(shapes), (PixelRect{0, 0, 60, 22}))
          << static_cast<int>(form) << ' ' << width_mm;
      EXPECT_GE(shapes.size(), 2U);
    }
}

// At its centre a road is its fill between its edges, with the style's width.
TEST(LegendSwatch, ALineHasTheWidthsAndColoursOfItsStyle) {
  const std::vector<DrawnShape> shapes = draw_swatch({.name = "road",
                                                      .ground = "#00ff00",
                                                      .fill = "#ffffff",
                                                      .casing = "#000000",
                                                      .width_mm = 2.0,
                                                      .casing_mm = 1.0},
                                                     box, 3.0);
  Grid<glm::vec3> picture(60, 22, glm::vec3(.5F));
  SheetPainter(Drawing{.size_px = box, .shapes = shapes}).paint(picture, {0, 0});
  int fill = 0, casing = 0, ground = 0;
  for (int y = 0; y < 22; ++y) {
    const glm::vec3 c = picture(30, y);
    (c.g > .5F ? (c.r > .5F ? fill : ground) : casing) += 1;
  }
  EXPECT_NEAR(fill, 6, 1);
  EXPECT_NEAR(casing, 6, 1);
  EXPECT_NEAR(ground, 10, 1);
}

TEST(LegendSwatch, DashesAreThoseOfTheFill) {
  const std::vector<DrawnShape> shapes =
      draw_swatch({.name = "railway", .dash_mm = {1.5, 1.0}}, box, 2.0);
  EXPECT_THAT(std::get<DrawnPath>(shapes.back()).dashes_px, testing::ElementsAre(3.0, 2.0));
  EXPECT_TRUE(std::get<DrawnPath>(shapes[shapes.size() - 2]).dashes_px.empty());
}

}  // namespace
}  // namespace belvedere
