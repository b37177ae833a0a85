#include "renderer/style/stroke_direction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/grids.h"
#include "tests/renderer/style/styled_sheet.h"

namespace belvedere {
namespace {

// A sheet of one class with the fall line `fall`, and its colour in OKLab.
struct Slope {
  GuidanceBuffers guidance;
  Grid<glm::vec3> lab;
};

Slope make_slope(LandCoverClass id, glm::vec2 fall, int side = 80) {
  Slope slope;
  const float depth = id == LandCoverClass::sky ? std::numeric_limits<float>::infinity() : 5000.0F;
  slope.guidance.depth_m = Grid<float>(side, side, depth);
  slope.guidance.land_cover = Grid<LandCoverClass>(side, side, id);
  slope.guidance.fall_line = Grid<glm::vec2>(side, side, fall);
  slope.lab = Grid<glm::vec3>(side, side, glm::vec3(0.5F, 0.0F, 0.0F));
  return slope;
}

Style style_of(double level, double form, double coherence = 0.5) {
  Style style = test::make_style();
  for (StyleBrushwork& b : style.brushwork) {
    b.level = level;
    b.form = form;
    b.coherence = coherence;
  }
  return style;
}

Grid<glm::vec2> direction(const Slope& slope, const Style& style) {
  return make_stroke_direction(style, slope.guidance, slope.lab,
                               test::make_style_parameters(slope.lab.width(), slope.lab.height()),
                               {0, 0});
}

TEST(StrokeDirection, RunsDownTheFallLineOfAFlatColour) {
  const glm::vec2 fall(0.6F, 0.8F);
  const Grid<glm::vec2> along =
      direction(make_slope(LandCoverClass::rock, fall), style_of(0.0, 0.5));
  EXPECT_NEAR(std::abs(glm::dot(along(40, 40), fall)), 1.0, 1e-5);
}

TEST(StrokeDirection, FollowsStripesOfLight) {
  Slope slope = make_slope(LandCoverClass::alpine_grass, glm::vec2(0.0F));
  // Bands whose light changes along (0.8, -0.6), so that they run along (0.6, 0.8).
  for (const auto [x, y] : test::cells(80, 80))
    slope.lab(x, y).x = 0.5F + 0.2F * static_cast<float>(std::sin(0.3 * (0.8 * x - 0.6 * y)));
  const Grid<glm::vec2> along = direction(slope, style_of(0.0, 0.8));
  EXPECT_GT(std::abs(glm::dot(along(40, 40), glm::vec2(0.6F, 0.8F))), 0.999);
}

TEST(StrokeDirection, WaterLiesLevelAndTreesStand) {
  const Grid<glm::vec2> lake =
      direction(make_slope(LandCoverClass::water, glm::vec2(0.0F)), style_of(0.9, 0.5));
  EXPECT_GT(std::abs(lake(40, 40).x), 0.9999);
  const Grid<glm::vec2> forest =
      direction(make_slope(LandCoverClass::forest, glm::vec2(0.0F, 1.0F)), style_of(0.2, 0.5));
  EXPECT_GT(std::abs(forest(40, 40).y), 0.9999);
}

TEST(StrokeDirection, SkyIsLevelOrWhorls) {
  const Slope sky = make_slope(LandCoverClass::sky, glm::vec2(0.0F), 160);
  const auto mean_level = [](const Grid<glm::vec2>& along) {
    double sum = 0.0;
    for (std::size_t i = 0; i < along.size(); ++i)
      sum += along[i].x * along[i].x - along[i].y * along[i].y;
    return sum / static_cast<double>(along.size());
  };
  EXPECT_GT(mean_level(direction(sky, style_of(0.95, 0.5))), 0.99);
  const double swirls = mean_level(direction(sky, style_of(-0.2, 0.5, 0.7)));
  EXPECT_LT(std::abs(swirls), 0.8);
}

// Length of the mean doubled angle, and of the means of squares of 16 px.
struct Steadiness {
  double whole;
  double near;
};

Steadiness steadiness_of(const Grid<glm::vec2>& along) {
  constexpr int side = 16;
  double whole_c = 0.0;
  double whole_s = 0.0;
  double near = 0.0;
  int squares = 0;
  for (int v = 0; v + side <= along.height(); v += side)
    for (int u = 0; u + side <= along.width(); u += side) {
      double c = 0.0;
      double s = 0.0;
      for (const auto [x, y] : test::cells({u, v, u + side, v + side})) {
        c += along(x, y).x * along(x, y).x - along(x, y).y * along(x, y).y;
        s += 2.0 * along(x, y).x * along(x, y).y;
      }
      whole_c += c;
      whole_s += s;
      near += std::hypot(c, s) / (side * side);
      ++squares;
    }
  return {std::hypot(whole_c, whole_s) / (side * side * squares), near / squares};
}

TEST(StrokeDirection, SwirlsHaveTheSizesOfThePaintingInASteadyFlow) {
  const Slope sky = make_slope(LandCoverClass::sky, glm::vec2(0.0F), 320);
  Style style = style_of(-0.2, 0.5, 0.7);
  StyleBrushwork& brushwork = style.brushwork[static_cast<std::size_t>(LandCoverClass::sky)];
  brushwork.steadiness = {0.9, 0.9, 0.9, 0.9};  // nothing turns: the flow alone
  EXPECT_GT(steadiness_of(direction(sky, style)).whole, 0.999);
  brushwork.steadiness = {0.9, 0.9, 0.9, 0.1};  // large swirls in hardly any flow
  const Steadiness large = steadiness_of(direction(sky, style));
  EXPECT_LT(large.whole, 0.6);
  EXPECT_GT(large.near, 0.9);
  brushwork.steadiness = {0.9, 0.3, 0.3, 0.3};  // small ones
  EXPECT_LT(steadiness_of(direction(sky, style)).near, large.near - 0.03);
}

TEST(StrokeDirection, StrokesFollowTheFormsOfCumulusClouds) {
  Slope sky = make_slope(LandCoverClass::sky, glm::vec2(0.0F));
  for (const auto [x, y] : test::cells(80, 80))
    sky.lab(x, y).x = 0.5F + 0.2F * static_cast<float>(std::sin(0.3 * x));  // upright bands
  Style style = style_of(0.9, 0.8);
  EXPECT_GT(std::abs(direction(sky, style)(40, 40).x), 0.99);
  style.sky.upper_edges = 0.35;
  EXPECT_GT(std::abs(direction(sky, style)(40, 40).y), 0.9);
}

TEST(StrokeDirection, IsAUnitVectorEverywhere) {
  const test::StyledSheet sheet = test::make_styled_sheet();
  const Grid<glm::vec2> along = make_stroke_direction(
      test::make_style(), sheet.guidance, sheet.render, test::make_style_parameters(), {0, 0});
  for (std::size_t i = 0; i < along.size(); ++i)
    ASSERT_NEAR(glm::dot(along[i], along[i]), 1.0F, 1e-5F);
}

TEST(StrokeDirection, ClassesWithoutStrokesTakeThoseOfARelative) {
  Style style;
  StyleBrushwork& rock = style.brushwork[static_cast<std::size_t>(LandCoverClass::rock)];
  rock.length_px = 12.0;
  rock.width_px = 3.0;
  style.brushwork[static_cast<std::size_t>(LandCoverClass::pasture)].length_px = 7.0;
  EXPECT_EQ(brushwork_of(style, LandCoverClass::scree).length_px, 12.0);
  EXPECT_EQ(brushwork_of(style, LandCoverClass::scree).width_px, 3.0);
  EXPECT_EQ(brushwork_of(style, LandCoverClass::forest).length_px, 7.0);
  EXPECT_EQ(brushwork_of(Style(), LandCoverClass::forest).length_px, 0.0);
}

}  // namespace
}  // namespace belvedere
