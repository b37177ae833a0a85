#pragma once

#include <cstdint>

#include "base/grid.h"
#include "base/guidance_channels.h"
#include "base/progress.h"
#include "renderer/rock/rock_view.h"

namespace belvedere {

// Pinnacles and notches. Where rock stands before what is farther, its edge rises and sinks with the spurs beneath it: each pixel of the
// shifted picture shows a pixel of the traced one, in its own column.
struct CrestShift {
  Grid<std::int16_t> rows;  // how many rows below (+) or above the pixel it shows lies
  Grid<float> front;        // as GuidanceBuffers::front, with the new edges
};

// Of pixels `wanted` of a window that holds traced depth, front and land cover, footprint; the result has their size. Reach:
// crest_margin_px up and down in the window, crest_view_margin_px in the wide view.
CrestShift shift_crests(const GuidanceBuffers& guidance, const WideView& wide, const RockParameters& parameters, glm::ivec2 origin_px,
                        PixelRect wanted);
int crest_margin_px(double pixels_per_unit);
int crest_view_margin_px(const RockParameters& parameters);
// Rows that a shifted pixel's source may lie away.
int crest_reach_px(double pixels_per_unit);

// The pixels `wanted` of traced guidance as shifted: every channel it has is gathered, front is the shift's. `guidance` must reach
// crest_reach_px beyond them where the sheet does.
GuidanceBuffers gather_rows(const GuidanceBuffers& guidance, const CrestShift& shift, PixelRect wanted);

}  // namespace belvedere
