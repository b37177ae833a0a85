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

// Noises that water is painted with; one set a thread.
struct WaterNoises {
  explicit WaterNoises(std::uint64_t seed) : wind(seed), ice(seed) {}
  WaterWind wind;
  LakeIce ice;
};

// What is known of all water of a picture.
struct WaterSources {
  const GuidanceBuffers& guidance;
  const Palette& palette;
  const WaterParameters& parameters;
  const GroundTint* tint = nullptr;  // colours of the ground's own; null: none
};

// A pixel of it.
struct WaterPixel {
  std::size_t index;          // in the buffers
  glm::dvec3 place_m;         // in the scene's CRS
  float metres_per_unit;      // of ground that a unit of the sheet shows
  WaterGround::Place ground;  // what lies below it; of depth 0 where that is not known
  const Mirrored& mirrored;
  float share;   // of water around, on the same surface
  float streak;  // noise, -1 … 1
  const Patches& patches;
  const WaterImage* image = nullptr;  // what is mirrored; null: it is looked up in the pixel's column, unless nothing shall be mirrored
  std::size_t image_index = 0;
};

// What a pixel of water is painted with.
struct WaterSurface {
  WaterLook look;
  LakeBed bed;
  float depth_m = 0.0F;
  float frozen = 0.0F;  // share of ice
};
WaterSurface water_surface(const WaterSources& water, WaterNoises& noises, const WaterPixel& pixel);

// The ice of a frozen lake over a colour, in `light` as palettes take it.
glm::vec3 frozen_over(const glm::vec3& colour, const WaterSources& water, WaterNoises& noises, const WaterPixel& pixel,
                      const WaterSurface& surface, double light);

}  // namespace belvedere
