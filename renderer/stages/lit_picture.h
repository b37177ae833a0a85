#pragma once

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "base/run.h"
#include "renderer/paint/base_picture.h"
#include "renderer/paint/palette.h"
#include "renderer/stages/ground_inputs.h"
#include "renderer/world/picture_parameters.h"
#include "renderer/world/world.h"

namespace belvedere {

// Parameters of the stages of a world's sheet, mean light included. All arguments must outlive
// them.
GroundInputs make_ground_inputs(const World& world, const SheetView& view, const Palette& palette,
                                const Run& run);

// A small picture made at once: traced channels with light and base picture, complete guidance
// buffers, and the base picture that strokes are painted on. Uses the stages of a sheet (stages.h),
// for one rectangle held in memory.
struct LitPicture {
  GuidanceBuffers guidance;  // tone and base included
  BasePicture base;
};
LitPicture make_lit_picture(const World& world, const Palette& palette, PixelRect region,
                            const Run& run);
// The same of another view of the world, such as a reduced one.
LitPicture make_lit_picture(const World& world, const SheetView& view, const Palette& palette,
                            PixelRect region, const Run& run);

// The mean light (light_of_tone) over the sunlit ground of the picture, weighted by the luminance
// of the ground's own colour, so that colours times light divided by this are on average as light
// as the ground's own. Measured on a small view of the whole picture, the same for every part of a
// sheet.
double mean_light_of(const World& world, const Palette& palette);

}  // namespace belvedere
