#pragma once

#include <cstdint>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/progress.h"
#include "renderer/rock/rock_view.h"
#include "renderer/trace/camera.h"

namespace belvedere {

// The synthetic relief of a picture's rock (spurs.h): everything downstream, from light to copying,
// uses the same rock.
struct RockRelief {
  Grid<LandCoverClass> land_cover;  // with the border of rock as spurs and debris draw it
  Grid<glm::vec2> fall_line;        // on rock that of each plane, followed by its strokes
  Grid<float> height;               // of the relief, units of the sheet; 0 without relief
  Grid<std::uint32_t> facet;  // number of the plane, 0 where there is no rock; connected planes
                              // share the upper half
  Grid<float> tone;           // light on the relief, -.3…1.4; on rock only
  Grid<glm::vec2> cover;      // shares of turf and of snow on treads, 0…1
};

// Relief of rock in a window of the sheet, pixel by pixel. Needs depth, positions, normals,
// altitude, land cover, shadow, sky view, slope, fall line and footprint; of the wide view also
// normals and footprints. A pixel reads the window within rock_near_margin_px, the wide view within
// rock_margin_px, and is the same in any window. Only the pixels `wanted` (empty: all) are made;
// the result has their size.
std::initializer_list<GuidanceMember> rock_channels();
RockRelief make_rock_relief(const GuidanceBuffers& guidance, const WideView& wide,
                            const RockParameters& parameters, glm::ivec2 origin_px,
                            Progress& progress, PixelRect wanted = {});
int rock_near_margin_px(const RockParameters& parameters);
int rock_margin_px(const RockParameters& parameters);

}  // namespace belvedere
