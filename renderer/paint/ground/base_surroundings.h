#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "renderer/paint/air.h"
#include "renderer/paint/forest_cover.h"
#include "renderer/paint/ground/ground_tint.h"
#include "renderer/paint/ground/slope_walk.h"
#include "renderer/paint/palette.h"
#include "renderer/paint/rock_kinds.h"
#include "renderer/paint/sky.h"
#include "renderer/paint/terrain_end.h"
#include "renderer/paint/water/water_ground.h"
#include "renderer/paint/water/water_image.h"
#include "renderer/paint/water/water_surface.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/light_field.h"

namespace belvedere {

// Parameters that turn ramps into the base picture.
struct BaseParameters {
  AirParameters air;
  const RockKind* rock = &rock_kinds().front();  // gives rock its hues
  double horizon_px = 0.0;  // row of the horizon in the whole picture (skyline_row_px of sky.h); 0:
                            // 0.18 of its height
  double sun_image_x = 1.0;  // as in ToneParameters
  double sunny_side = 1.0;  // 1: the noon sun stands in the south, as it does north of the tropics;
                            // -1: in the north
  double pixels_per_unit = 1.0;
  std::uint64_t seed = 1;
  std::uint64_t sky_seed = 1;  // of the sky alone: each view of a scene has its own sky
  // 0: tone picks colours from the palette's ramps. Otherwise: the mean light of lit ground; the
  // colour is that of the ramp at the middle tone, times the light of the pixel's tone divided by
  // this mean.
  double mean_light = 0.0;
  bool tones = true;  // BasePicture::darker and lighter, from which strokes are mixed; else colour
  std::shared_ptr<const WaterGround> waters =
      nullptr;  // lakes and their beds; null: all water looks the same and no bed shows
  WaterParameters water;
  std::shared_ptr<const LightField> light_field =
      nullptr;  // gives lit ground its warmth; null: the palette's alone
  std::shared_ptr<const GroundTint> tint =
      nullptr;  // the ground's own colours, towards which ramps are shifted; null: plain ramps
  std::optional<TerrainSides> sides = {};  // of the data; none: they do not fade at their sides
};

// Surroundings that a pixel of the base picture depends on. Grids have the size of the buffers,
// except `bare` and `sky`.
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
