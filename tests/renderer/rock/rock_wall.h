#pragma once

#include "base/guidance_buffers.h"
#include "renderer/paint/rock_kinds.h"
#include "tests/grids.h"
#include "tests/renderer/exemplar/painted_hills.h"

namespace belvedere::test {

// A steep wall of rock that faces the viewer, falls straight down the sheet and has even light: 44
// m of ground in a mm of the sheet.
inline GuidanceBuffers make_wall(int width, int height, double pixels_per_unit,
                                 LandCoverClass id = LandCoverClass::rock) {
  GuidanceBuffers g = make_hills(width, height, pixels_per_unit);
  const glm::vec3 normal = glm::normalize(glm::vec3(0.0F, 1.0F, 0.6F));
  for (const auto [x, y] : test::cells(width, height)) {
    const std::size_t i = g.depth_m.index(x, y);
    const double metres = 22.0 / pixels_per_unit;
    g.depth_m[i] = static_cast<float>(50000.0 - 0.5 * metres * y);
    g.position_m[i] = {static_cast<float>(metres * x), 0.0F,
                       static_cast<float>(2600.0 - metres * y)};
    g.altitude_m[i] = g.position_m[i].z;
    g.normal[i] = g.normal_detail[i] = g.normal_smooth[i] = normal;
    g.slope_deg[i] = 59.0F;
    g.fall_line[i] = {0.0F, 1.0F};
    g.shadow[i] = g.sky_view[i] = 1.0F;
    g.footprint_m[i] = static_cast<float>(metres);
    g.land_cover[i] = id;
  }
  return g;
}

inline const RockKind& limestone() { return find_rock_kind("limestone"); }

}  // namespace belvedere::test
