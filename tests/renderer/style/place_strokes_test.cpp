#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/style/paint_style.h"
#include "renderer/style/style_strokes.h"
#include "tests/renderer/style/styled_sheet.h"

namespace belvedere {
namespace {

constexpr PixelRect all_of_it{0, 0, test::sheet_width, test::sheet_height};

struct Placed {
  test::StyledSheet sheet = test::make_styled_sheet();
  Style style = test::make_style();
  StylePaintParameters parameters = test::make_style_parameters();
  StyleGround ground =
      prepare_style(style, sheet.guidance, sheet.render, {}, parameters, {0, 0}, all_of_it);
  StyleWindow window{sheet.guidance, ground, {0, 0}};

  std::vector<StyleStroke> of(int layer) const {
    return place_style_strokes(style, window, parameters, layer, all_of_it);
  }
};

double length_of(const StyleStroke& stroke) {
  double sum = 0.0;
  for (int k = 0; k + 1 < stroke.count; ++k)
    sum += glm::length(stroke.points[static_cast<std::size_t>(k) + 1] -
                       stroke.points[static_cast<std::size_t>(k)]);
  return sum;
}

// 6 and 2.5 px of the painting, one unit and thus one pixel each, times 1.4 in the first layer.
TEST(PlaceStrokes, LengthsAndWidthsAreThePaintingsAndShorterFarAway) {
  Placed placed;
  const auto means = [&placed] {
    double length = 0.0;
    double width = 0.0;
    int count = 0;
    for (const StyleStroke& stroke : placed.of(0)) {
      if (stroke.id != LandCoverClass::pasture) continue;
      length += length_of(stroke);
      width += 2.0 * stroke.half_width_px;
      ++count;
    }
    EXPECT_GT(count, 300);
    return glm::dvec2(length, width) / static_cast<double>(count);
  };
  placed.parameters.near_m = 50'000.0;  // beyond the pasture
  const glm::dvec2 near = means();
  EXPECT_NEAR(near.x, 8.4, 0.4);
  EXPECT_NEAR(near.y, 3.5, 0.1);
  placed.parameters.near_m = 100.0;
  placed.parameters.far_m = 200.0;
  EXPECT_NEAR(means().x, 0.6 * near.x, 0.2);
}

// Regions of 110 units: the spread of colours differs between the ends of the sheet's noise.
TEST(PlaceStrokes, ContrastVariesBetweenRegions) {
  Placed placed;
  const auto jitters = [&placed](double share) {
    placed.parameters.unevenness = share;
    std::vector<double> of;
    for (const StyleStroke& stroke : placed.of(1))
      if (stroke.id == LandCoverClass::pasture)
        of.push_back(glm::length(glm::dvec3(stroke.colour - stroke.ground)));
    return of;
  };
  const std::vector<double> even = jitters(0.0);
  const std::vector<double> uneven = jitters(1.0);
  ASSERT_EQ(even.size(), uneven.size());
  double min_ratio = 10.0;
  double max_ratio = 0.0;
  for (std::size_t i = 0; i < even.size(); ++i) {
    if (even[i] < 0.01) continue;
    min_ratio = std::min(min_ratio, uneven[i] / even[i]);
    max_ratio = std::max(max_ratio, uneven[i] / even[i]);
  }
  EXPECT_GT(max_ratio / min_ratio, 1.3);
  EXPECT_LT(max_ratio, 1.9);
}

TEST(PlaceStrokes, TheirOrderIsTheirCellsNotTheirPlaces) {
  const std::vector<StyleStroke> strokes = Placed().of(1);
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < strokes.size(); ++k) {
    ASSERT_LE(strokes[k].order, strokes[k + 1].order);
    sum += std::abs(strokes[k + 1].pixel_px.y - strokes[k].pixel_px.y);
  }
  EXPECT_GT(sum / static_cast<double>(strokes.size()), 60.0);
}

TEST(PlaceStrokes, ColoursScatterAroundTheGround) {
  const Placed placed;
  glm::dvec3 sum(0.0);
  double squares = 0.0;
  int count = 0;
  for (const StyleStroke& stroke : placed.of(0)) {
    const glm::dvec3 apart(stroke.colour - stroke.ground);
    sum += apart;
    squares += apart.x * apart.x;
    ++count;
  }
  EXPECT_LT(glm::length(sum / static_cast<double>(count)), 0.01);
  // .9 of the residuals' .03, times the limit of a quarter, times .6 in the first layer.
  EXPECT_GT(std::sqrt(squares / count), 0.008);
  EXPECT_LT(std::sqrt(squares / count), 0.030);
}

TEST(PlaceStrokes, ShadeTakesResidualsOfShade) {
  Placed placed;
  for (StyleBrushwork& b : placed.style.brushwork)
    b.residuals = {std::vector<glm::vec3>{{0.0F, -0.02F, 0.0F}},
                   std::vector<glm::vec3>{{0.0F, 0.0F, 0.0F}},
                   std::vector<glm::vec3>{{0.0F, 0.02F, 0.0F}}};
  for (const StyleStroke& stroke : placed.of(0)) {
    if (stroke.id == LandCoverClass::sky) continue;
    const float tone = placed.sheet.guidance.tone(stroke.pixel_px.x, stroke.pixel_px.y);
    const float hue = stroke.colour.y - stroke.ground.y;
    ASSERT_TRUE(tone > 0.34F || hue < -0.005F) << tone << " " << hue;
    ASSERT_TRUE(tone < 0.84F || hue > 0.005F) << tone << " " << hue;
  }
}

TEST(PlaceStrokes, AStyleWithoutBrushworkHasNone) {
  Placed placed;
  placed.style.brushwork = {};
  EXPECT_TRUE(placed.of(0).empty());
}

TEST(PlaceStrokes, SeedsLieWithinReach) {
  const Placed placed;
  const PixelRect rect{100, 100, 140, 140};
  const int reach = style_seed_reach_px(placed.style, placed.parameters);
  for (const StyleStroke& stroke :
       place_style_strokes(placed.style, placed.window, placed.parameters, 1, rect)) {
    ASSERT_TRUE(stroke.pixel_px.x >= rect.x0 - reach && stroke.pixel_px.x < rect.x1 + reach);
    ASSERT_LE(length_of(stroke) / 2.0 + stroke.half_width_px, reach);
  }
}

}  // namespace
}  // namespace belvedere
