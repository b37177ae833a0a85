#pragma once

#include <cstdint>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/progress.h"
#include "renderer/rock/rock_view.h"

namespace belvedere {

// Pinnacles and notches. Where rock stands in front of farther ground, its edge rises and sinks
// with the spurs beneath it: each pixel of the shifted picture shows a pixel of the traced one, in
// its own column.
struct CrestShift {
  Grid<std::int16_t> rows;  // rows from the pixel down (+) or up to the one that it shows
  Grid<float> front;        // as GuidanceBuffers::front, with the new edges
};

// For the pixels `wanted` of a window with traced depth, front, land cover and footprint; the
// result has their size. Reach: crest_margin_px up and down in the window, crest_view_margin_px in
// the wide view.
CrestShift shift_crests(const GuidanceBuffers& guidance, const WideView& wide,
                        const RockParameters& parameters, glm::ivec2 origin_px, PixelRect wanted);
int crest_margin_px(double pixels_per_unit);
int crest_view_margin_px(const RockParameters& parameters);
// Max distance of a shifted pixel's source, rows.
int crest_reach_px(double pixels_per_unit);

// The pixels `wanted` of traced guidance after the shift: every channel present is gathered; front
// is the shift's. `guidance` must extend crest_reach_px beyond them where the sheet does.
GuidanceBuffers gather_rows(const GuidanceBuffers& guidance, const CrestShift& shift,
                            PixelRect wanted);

}  // namespace belvedere
