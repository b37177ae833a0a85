#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "base/progress.h"
#include "renderer/paint/air_parameters.h"
#include "renderer/paint/ground/ground_tint.h"
#include "renderer/paint/palette.h"
#include "renderer/paint/rock_kinds.h"
#include "renderer/paint/water/water_image.h"
#include "renderer/paint/water/water_parameters.h"
#include "renderer/trace/light_field.h"
#include "renderer/trace/water/water_ground.h"
#include "renderer/trace/wide_view.h"
#include "texture/strokes/stroke_painter.h"

namespace belvedere {

// What turns ramps into the base picture.
struct BaseParameters {
  AirParameters air;
  const RockKind* rock = &rock_kinds().front();  // whose hues rock has
  double horizon_px = 0.0;                       // row of the horizon in the whole picture (skyline_row_px of sky.h); 0: 0.18 of its height
  double sun_image_x = 1.0;                      // as in ToneParameters
  double sunny_side = 1.0;                       // 1: the noon sun stands in the south, as it does north of the tropics; -1: in the north
  double pixels_per_unit = 1.0;
  std::uint64_t seed = 1;
  std::uint64_t sky_seed = 1;  // of the sky alone: views of one scene have skies of their own
  // 0: tone chooses colours in the palette's ramps. Else the ground has the ramps' colour at the middle tone, multiplied by the light that
  // its tone stands for over this: the mean light of lit ground.
  double mean_light = 0.0;
  std::shared_ptr<const WaterGround> waters = nullptr;  // lakes and their beds; none: all water is alike, and no bed is seen
  WaterParameters water;
  std::shared_ptr<const LightField> light_field = nullptr;  // whose warmth lit ground takes; none: the palette's alone
  std::shared_ptr<const GroundTint> tint = nullptr;         // colours of the ground's own that ramps are moved to; none: ramps as they are
};

// Base picture (encoded sRGB) at the pixel's tone and at ∓ .17, with accents, tree density and haze; sky pixels get sky and clouds.
// Needs depths, places, altitudes, classes, tone, fall lines, slopes, footprints, relief of all sizes, smooth normals, heights above
// the valley, rim, built and grain.
// `origin_px`, `picture_size`: where the buffers lie in the whole picture. Local up to base_margin_px(): a part with that margin equals
// the whole bit for bit. Of the buffers' pixels only those `wanted` (empty: all) are made: the result has their size. Where a wide view is
// given, it is what must reach so far; the buffers themselves need no more than base_window(wanted). `image`: what the water of the wanted
// pixels mirrors, of their size; null: it is looked up in their columns, unless nothing shall be mirrored.
BasePicture make_base_picture(const GuidanceBuffers& guidance, const WideView& wide, const Palette& palette,
                              const BaseParameters& parameters, glm::ivec2 origin_px, glm::ivec2 picture_size, Progress& progress,
                              PixelRect wanted = {}, const WaterImage* image = nullptr);
BasePicture make_base_picture(const GuidanceBuffers& guidance, const Palette& palette, const BaseParameters& parameters,
                              glm::ivec2 origin_px, glm::ivec2 picture_size, Progress& progress, PixelRect wanted = {});
int base_margin_px(const BaseParameters& parameters);
// Wanted pixels and what is asked around them, where a wide view is given. has_water: whether any of them is water, which looks up and down
// for its shores.
PixelRect base_window(PixelRect wanted, bool has_water, const BaseParameters& parameters);

}  // namespace belvedere
