#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "renderer/paint/ground/ground_tint.h"
#include "renderer/paint/ground/lake_bed.h"
#include "renderer/paint/ground_hues.h"
#include "renderer/paint/palette.h"
#include "renderer/paint/reflection.h"
#include "renderer/paint/water/lake_ice.h"
#include "renderer/paint/water/water_image.h"
#include "renderer/paint/water/water_parameters.h"
#include "renderer/paint/water/water_wind.h"
#include "renderer/paint/water_look.h"
#include "renderer/trace/water/water_ground.h"

namespace belvedere {

// Noises of painted water; use one set per thread.
struct WaterNoises {
  explicit WaterNoises(std::uint64_t seed) : wind(seed), ice(seed) {}
  WaterWind wind;
  LakeIce ice;
};

// Inputs common to all water of a picture.
struct WaterSources {
  const GuidanceBuffers& guidance;
  const Palette& palette;
  const WaterParameters& parameters;
  const GroundTint* tint = nullptr;  // the ground's own colours; null: none
};

// A pixel of water.
struct WaterPixel {
  std::size_t index;          // in the buffers
  glm::dvec3 position_m;      // in the scene's CRS
  float metres_per_unit;      // ground in a unit of the sheet
  WaterGround::Place ground;  // what lies below it; depth 0 where unknown
  const Mirrored& mirrored;
  float river = 0.0F;  // 1 a river … 0 a lake, or unknown
  float share;         // of water around, on the same surface
  float streak;        // noise, -1 … 1
  const Patches& patches;
  const WaterImage* image = nullptr;  // the reflection; null: it is looked up in the pixel's
                                      // column, unless nothing shall be mirrored
  std::size_t image_index = 0;
};

// The paint of a pixel of water.
struct WaterSurface {
  WaterLook look;
  LakeBed bed;
  float depth_m = 0.0F;
  float frozen = 0.0F;  // share of ice
};
WaterSurface water_surface(const WaterSources& water, WaterNoises& noises, const WaterPixel& pixel);

// Lays the ice of a frozen lake over a colour; `light` as for palettes.
glm::vec3 frozen_over(const glm::vec3& colour, const WaterSources& water, WaterNoises& noises,
                      const WaterPixel& pixel, const WaterSurface& surface, double light);

}  // namespace belvedere
