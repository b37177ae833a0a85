#pragma once

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "renderer/close/roofs.h"

namespace belvedere {

// Classes whose borders follow a small relief where they are near: grass, shrub, scree, snow, ice.
bool is_open_ground(LandCoverClass id);

// What borders of a window of the sheet are read from.
struct CloseBorders {
  const GuidanceBuffers& guidance;
  const SpurGround& ground;
  glm::ivec2 origin_px;
  SpurCells roofs;  // grow_roofs of border_roofs
  std::uint64_t seed = 1;

  // The class that a pixel of the window shows: that of a place displaced down the fall line by the
  // relief and broken noise, on the same surface. `close`: 0…1.
  LandCoverClass at(int x, int y, float close) const;
};
inline constexpr RoofSize border_roofs{.spacing_units = 13.0F, .slender = 0.5F, .lean_rad = 0.3F};
inline constexpr std::uint64_t border_roofs_part = 0;
inline constexpr float border_reach_units = 10.0F;  // of a displacement

}  // namespace belvedere
