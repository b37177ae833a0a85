#pragma once

#include <glm/vec2.hpp>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "base/progress.h"
#include "renderer/paint/ground/base_parameters.h"
#include "renderer/paint/palette.h"
#include "renderer/paint/water/water_image.h"
#include "renderer/trace/wide_view.h"
#include "texture/strokes/stroke_painter.h"

namespace belvedere {

// Base picture (encoded sRGB) at the pixel's tone and at ∓ .17, with accents, tree density and
// haze; sky pixels get sky and clouds. Needs depths, positions, altitudes, classes, tone, fall
// lines, slopes, footprints, relief of all sizes, smooth normals, heights above the valley, rim,
// built and grain. `origin_px`, `picture_size`: position of the buffers in the whole picture. Local
// up to base_margin_px() of base_surroundings.h: a part with that margin equals the whole bit for
// bit. Only the `wanted` pixels of the buffers (empty: all) are made; the result has their size.
// With a wide view only that must reach so far; the buffers need no more than base_window(wanted).
// `image`: the reflections in the water of the wanted pixels, of their size; null: looked up in
// their columns, unless mirroring is off.
BasePicture make_base_picture(const GuidanceBuffers& guidance, const WideView& wide,
                              const Palette& palette, const BaseParameters& parameters,
                              glm::ivec2 origin_px, glm::ivec2 picture_size, Progress& progress,
                              PixelRect wanted = {}, const WaterImage* image = nullptr);
BasePicture make_base_picture(const GuidanceBuffers& guidance, const Palette& palette,
                              const BaseParameters& parameters, glm::ivec2 origin_px,
                              glm::ivec2 picture_size, Progress& progress, PixelRect wanted = {});

}  // namespace belvedere
