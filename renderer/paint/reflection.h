#pragma once

#include <cstdint>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"

namespace belvedere {

// Reflections in water: painters set the dark image of the far shore upside down into the far part
// of a lake, stretched downwards.
inline constexpr float open_water = 1e6F;
struct Mirrored {
  Grid<std::int32_t> source;  // index of the pixel whose image a water pixel shows; -1 where it
                              // shows the sky, and off the water
  Grid<float> share;          // 0…1, how strongly; 1 at the far shore
  Grid<float> to_far;  // units of the sheet up to the far shore; open_water if none is within reach
  Grid<float> to_near;  // the same down to the near shore
};

// Looks up each column of water for its far shore, at most reflection_units away, and from there
// the same distance up again, never across the next silhouette (a farther range is not reflected at
// this bank). A level shore has no image, the slope behind it has a weaker one. Narrow water
// reflects little: a brook shows the sky. Reach: reflection_margin_px(). Pixels outside `wanted`
// (empty: all) show nothing.
Mirrored find_reflections(const GuidanceBuffers& guidance, double pixels_per_unit,
                          PixelRect wanted = {});
int reflection_margin_px(double pixels_per_unit);

}  // namespace belvedere
