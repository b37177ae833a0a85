#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "renderer/paint/air_parameters.h"
#include "renderer/paint/ground/ground_tint.h"
#include "renderer/paint/rock_kinds.h"
#include "renderer/paint/terrain_end.h"
#include "renderer/paint/water/water_parameters.h"
#include "renderer/trace/light_field.h"
#include "renderer/trace/water/water_ground.h"

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
  std::shared_ptr<const WaterGround> waters =
      nullptr;  // lakes and their beds; null: all water looks the same and no bed shows
  WaterParameters water;
  std::shared_ptr<const LightField> light_field =
      nullptr;  // gives lit ground its warmth; null: the palette's alone
  std::shared_ptr<const GroundTint> tint =
      nullptr;  // the ground's own colours, towards which ramps are shifted; null: plain ramps
  std::optional<TerrainSides> sides = {};  // of the data; none: they do not fade at their sides
};

}  // namespace belvedere
