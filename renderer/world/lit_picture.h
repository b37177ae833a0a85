#pragma once

#include "base/guidance_buffers.h"
#include "base/parallel.h"
#include "base/run.h"
#include "renderer/paint/base_picture.h"
#include "renderer/paint/palette.h"
#include "renderer/world/world.h"

namespace belvedere {

// The traced channels with light and base picture: complete guidance buffers, and the base picture that strokes are painted on.
struct LitPicture {
  GuidanceBuffers guidance;  // tone and base included
  BasePicture base;
};
// A rectangle of the picture. Where it is only a part, the outer lit_margin_px() pixels are not final.
LitPicture make_lit_picture(const World& world, const Palette& palette, PixelRect region, const Run& run);
int lit_margin_px(const Scene& scene);

// The hand in which the strokes of a world are painted.
StrokeParameters to_stroke_parameters(const World& world, const Palette& palette);

}  // namespace belvedere
