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

// What the stages of a world's sheet are made with, mean light included. All arguments must outlive it.
GroundInputs make_ground_inputs(const World& world, const SheetView& view, const Palette& palette, const Run& run);

// A small picture at once: traced channels with light and base picture, complete guidance buffers, and the base picture that strokes are
// painted on. The stages of a sheet (stages.h), asked for one rectangle and held in memory.
struct LitPicture {
  GuidanceBuffers guidance;  // tone and base included
  BasePicture base;
};
LitPicture make_lit_picture(const World& world, const Palette& palette, PixelRect region, const Run& run);

// The mean light (light_of_tone) over the ground of the picture that lies in the sun, weighed by the luminance of the ground's own colour,
// so that colours times light over it are as light there as the ground's own; measured on a small view of the whole picture, the same for
// every part of a sheet.
double mean_light_of(const World& world, const Palette& palette);

}  // namespace belvedere
