#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "renderer/paint/forest_cover.h"
#include "renderer/paint/ground/base_parameters.h"
#include "renderer/paint/ground/scree_fans.h"
#include "renderer/paint/palette.h"
#include "renderer/paint/reflection.h"
#include "renderer/paint/sky.h"
#include "renderer/trace/wide_view.h"

namespace belvedere {

// What a pixel of the base picture needs from the picture around it. Grids have the size of the
// buffers, but for `bare` and `sky`.
struct BaseSurroundings {
  Grid<float> log_depth;
  Grid<float> mean_log_depth;
  Grid<float> wood;     // share of forest around
  ForestCover cover;    // of forest pixels
  Grid<float> bare;     // share of ground without snow and ice around each wide pixel, on the same
                        // surface; empty where there is no ice
  ScreeFans fans;       // of scree pixels
  Grid<float> water;    // share of water around, on the same surface
  Mirrored mirrored;    // of water pixels; empty where there is none
  Grid<float> streaks;  // the same
  Grid<float> mist;     // where hollows of far ranges hold mist, 0…1
  Grid<glm::vec3> sky;  // of the wanted sky pixels
};

// Buffers, wide view, position and wanted pixels as in make_base_picture.
BaseSurroundings look_around(const GuidanceBuffers& guidance, const WideView& wide,
                             const Palette& palette, const BaseParameters& parameters,
                             const SkyParameters& sky, glm::ivec2 origin_px, PixelRect wanted);

// How far it reaches, at most: through the wide view.
int base_margin_px(const BaseParameters& parameters);
// The wanted pixels and those read around them where a wide view is given. has_water: whether any
// of them is water, which needs the shores above and below.
PixelRect base_window(PixelRect wanted, bool has_water, const BaseParameters& parameters);

}  // namespace belvedere
