#pragma once

#include "renderer/paint/rock_kinds.h"
#include "renderer/rock/rock_relief.h"
#include "tests/grids.h"
#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere::test {

// Slopes seen from near: `metres_per_unit` of ground in a unit of the sheet, half of it of one
// class and half of another.
inline GuidanceBuffers make_close_hills(int width, int height, double pixels_per_unit,
                                        double metres_per_unit, LandCoverClass left,
                                        LandCoverClass right) {
  GuidanceBuffers g = make_hills(width, height, pixels_per_unit);
  for (const auto [x, y] : test::cells(width, height)) {
    const std::size_t i = g.depth_m.index(x, y);
    if (g.is_sky(i)) continue;
    g.footprint_m[i] = static_cast<float>(metres_per_unit / pixels_per_unit);
    g.land_cover[i] = x < width / 2 ? left : right;
  }
  return g;
}

inline RockParameters close_parameters(double pixels_per_unit) {
  RockParameters p;
  p.light.pixels_per_unit = pixels_per_unit;
  p.kind = &find_rock_kind("limestone");
  return p;
}

// A relief without rock.
inline RockRelief bare_relief(const GuidanceBuffers& g, PixelRect rect) {
  const int width = rect.width();
  const int height = rect.height();
  return {cut(g.land_cover, rect),          cut(g.fall_line, rect),
          Grid<float>(width, height, 0.0F), Grid<std::uint32_t>(width, height, 0U),
          Grid<float>(width, height, 0.0F), Grid<glm::vec2>(width, height, glm::vec2(0.0F))};
}

}  // namespace belvedere::test
