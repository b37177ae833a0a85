#pragma once

#include <glm/vec3.hpp>
#include <memory>

#include "base/angle.h"
#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "base/progress.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/light_field.h"
#include "renderer/trace/sampling.h"
#include "renderer/trace/sun.h"
#include "renderer/trace/terrain_model.h"
#include "renderer/trace/tracer.h"
#include "terrain/deform/deform.h"

namespace belvedere {

struct GuidanceParameters {
  SamplingParameters sampling;
  double shadow_bias_m = 0.05;  // offset of secondary rays above the facet, 0…100
  glm::dvec3 sun_direction{
      -0.612, 0.612,
      0.5};  // unit, towards the sun (x east, y north, z up); z <= 0: all terrain in shadow
  double sun_radius_rad =
      to_radians(painted_sun_radius_deg);  // radius of the disc: softness of cast shadows, 0…0.5
  // Light that varies with position: the suns that cast shadows; null: sun_direction everywhere.
  std::shared_ptr<const LightField> light_field = nullptr;
  int tile_size = 32;  // px, 8…4096; does not change the result
};

// Traces a rectangle of the picture: the channels of ChannelMaker::trace
// (base/guidance_channels.h). The buffers have the rectangle's size. position_m is relative to
// surface.origin, which becomes origin_m. ridge is relief_s / (|relief_s| + 10 m), -1…1. Terrain
// without a known class counts as rock. Any split of the picture into rectangles gives the same
// bits, except silhouette and sky_view, which read neighbours and need a margin of
// guidance_margin_px(). terrain and surface have the same posts. Throws Error(usage) for parameters
// out of range; the message names the field.
GuidanceBuffers trace_guidance(const TerrainModel& terrain, const DeformedSurface& surface,
                               const Tracer& tracer, const Camera& camera,
                               const GuidanceParameters& parameters, PixelRect region,
                               Progress& progress);

// How far a pixel's values reach into its neighbourhood.
constexpr int guidance_margin_px() { return 2; }

}  // namespace belvedere
