#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/random.h"
#include "renderer/image/srgb.h"
#include "renderer/style/style.h"
#include "tests/grids.h"

namespace belvedere::test {

inline constexpr int sheet_width = 300;
inline constexpr int sheet_height = 260;
inline constexpr int sky_end = 60;  // first row of ground

// A sheet with all inputs of strokes: sky, a distant range of rock, a slope of forest and
// meadow, a lake.
struct StyledSheet {
  GuidanceBuffers guidance;
  Grid<glm::vec3> render;
};

inline StyledSheet make_styled_sheet(int width = sheet_width, int height = sheet_height) {
  using enum LandCoverClass;
  StyledSheet sheet;
  GuidanceBuffers& g = sheet.guidance;
  g.depth_m = Grid<float>(width, height, std::numeric_limits<float>::infinity());
  g.land_cover = Grid<LandCoverClass>(width, height, sky);
  g.tone = Grid<float>(width, height, 0.0F);
  g.fall_line = Grid<glm::vec2>(width, height, glm::vec2(0.0F));
  g.valley_height_m = Grid<float>(width, height, 0.0F);
  sheet.render = Grid<glm::vec3>(width, height, glm::vec3(0.6F, 0.7F, 0.9F));
  for (const auto [x, y] : test::cells({0, sky_end, width, height})) {
    const bool far = y < 110;
    g.depth_m(x, y) = far ? 60000.0F : 12000.0F - 10.0F * static_cast<float>(y);
    const bool lake = !far && x > 180 && x < 240 && y > 150 && y < 200;
    g.land_cover(x, y) = far ? rock : lake ? water : x < 130 ? forest : pasture;
    g.tone(x, y) = 0.5F + 0.4F * static_cast<float>(std::sin(0.11 * x + 0.07 * y));
    g.fall_line(x, y) = lake ? glm::vec2(0.0F) : glm::vec2(0.6F, 0.8F);
    g.valley_height_m(x, y) = 2.0F * static_cast<float>(height - y);
    const auto light =
        static_cast<float>(0.25 + 0.3 * g.tone(x, y) + 0.1 * random_uniform(5, x, y));
    sheet.render(x, y) = light * (lake  ? glm::vec3(0.5F, 0.7F, 1.0F)
                                  : far ? glm::vec3(1.0F, 0.9F, 0.8F)
                                        : glm::vec3(0.8F, 1.0F, 0.5F));
  }
  return sheet;
}

inline StyledSheet cut(const StyledSheet& sheet, PixelRect rect) {
  StyledSheet out;
  const GuidanceBuffers& g = sheet.guidance;
  out.guidance.depth_m = part_of(g.depth_m, rect);
  out.guidance.land_cover = part_of(g.land_cover, rect);
  out.guidance.tone = part_of(g.tone, rect);
  out.guidance.fall_line = part_of(g.fall_line, rect);
  out.guidance.valley_height_m = part_of(g.valley_height_m, rect);
  out.render = part_of(sheet.render, rect);
  return out;
}

// Brushwork for every class, with residuals and accents; a sky of three columns.
inline Style make_style() {
  Style style;
  style.units_per_px = 1.0;
  style.broken = 0.8;
  style.vapour = 0.5;
  style.unevenness = 0.7;
  style.contour_lines = 1.0;
  style.trend = glm::vec3(0.08F, 0.0F, -0.03F);
  for (StyleBrushwork& b : style.brushwork) {
    b.length_px = 6.0;
    b.width_px = 2.5;
    b.level = 0.3;
    b.form = 0.5;
    b.coherence = 0.6;
    b.lightness_deviation = 0.04;
    for (std::size_t part = 0; part < 3; ++part)
      for (int k = 0; k < 16; ++k)
        b.residuals[part].push_back(
            0.03F * glm::vec3(random_normal(3, k, static_cast<std::int64_t>(part)),
                              0.3 * random_normal(4, k, 0), 0.3 * random_normal(5, k, 0)));
    b.accents.assign(4, glm::vec3(0.5F, 0.1F, 0.1F));
  }
  style.sky.medians = Grid<glm::vec3>(3, 5, glm::vec3(0.75F, 0.0F, -0.05F));
  style.sky.changes.push_back({.axis = glm::vec3(0.04F, 0.01F, 0.02F),
                               .length_x = 0.1,
                               .length_y = 0.2,
                               .quantiles = {-2.0, -1.2, -0.7, 0.0, 0.7, 1.2, 2.0}});
  return style;
}

inline StylePaintParameters make_style_parameters(int width = sheet_width,
                                                  int height = sheet_height) {
  StylePaintParameters parameters{
      .sheet_px = {width, height}, .sky_rows = sky_end, .seed = 11, .contour_lines = 0.0};
  return parameters;
}

}  // namespace belvedere::test
