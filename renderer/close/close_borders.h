#pragma once

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "renderer/close/roofs.h"

namespace belvedere {

// Classes whose borders follow a small relief where they are near: grass, shrub, scree, snow, ice.
bool is_open_ground(LandCoverClass id);

// Shares of ice and of everything white around each wide pixel on its own surface, 0…1.
struct IceAround {
  Grid<float> ice;    // of glaciers, within some units
  Grid<float> white;  // of snow, too, within a gully's distance
};
// Computes the shares for the wide pixels that `sheet_rect` reads.
IceAround look_around_ice(const SpurGround& ground, PixelRect sheet_rect);
int ice_around_reach(double pixels_per_unit, int factor);  // wide pixels

// Inputs of the borders of classes in a window of the sheet.
struct CloseBorders {
  const GuidanceBuffers& guidance;
  const SpurGround& ground;
  glm::ivec2 origin_px;
  SpurCells tongues, teeth;  // grow_roofs of border_tongues and border_teeth
  Grid<std::uint8_t> mixed;  // of wide pixels: whether another class is within reach
  const IceAround& ice;
  std::uint64_t seed = 1;

  // The class that a pixel of the window shows: that of a place displaced down the fall line by the
  // relief and broken noise, on the same surface. Of open ground and forest. `close`: 0…1.
  LandCoverClass at(int x, int y, float close) const;
};
// Two sizes: large tongues break the round outlines that cells of elevation data leave, small teeth
// break those.
inline constexpr RoofSize border_tongues{.spacing_units = 38.0F, .slender = 0.5F, .lean_rad = 0.4F};
inline constexpr RoofSize border_teeth{.spacing_units = 13.0F, .slender = 0.5F, .lean_rad = 0.3F};
inline constexpr std::uint64_t border_teeth_part = 0;
inline constexpr std::uint64_t border_tongues_part = 39;
inline constexpr float border_reach_units = 20.0F;  // of a displacement

// Borders of a window that holds `sheet_rect`. Reads the wide view within border_reach_units and
// the reach of its roofs.
CloseBorders make_close_borders(const GuidanceBuffers& guidance, const SpurGround& ground,
                                const IceAround& ice, glm::ivec2 origin_px, PixelRect sheet_rect,
                                std::uint64_t seed);

}  // namespace belvedere
