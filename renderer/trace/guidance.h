#pragma once

#include <glm/vec3.hpp>
#include <memory>

#include "base/grid.h"
#include "base/guidance_buffers.h"
#include "base/math.h"
#include "base/pixel_rect.h"
#include "base/progress.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/guidance_rays.h"
#include "renderer/trace/light_field.h"
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
// (base/guidance_buffers.h). The buffers have the rectangle's size. position_m is relative to
// surface.origin, which becomes origin_m. ridge is relief_s / (|relief_s| + 10 m), -1…1. Terrain
// without a known class counts as rock. Any split of the picture into rectangles gives the same
// bits, except silhouette and sky_view, which read neighbours and need a margin of
// guidance_margin_px(). terrain and surface have the same posts. Throws Error(usage) for parameters
// out of range; the message names the field.
GuidanceBuffers trace_guidance(const TerrainModel& terrain, const DeformedSurface& surface,
                               const Tracer& tracer, const Camera& camera,
                               const GuidanceParameters& parameters, PixelRect region,
                               Progress& progress);

// The channel `shadow` alone, with the same bits: for another sun over what is traced already.
Grid<float> trace_shadows(const TerrainModel& terrain, const DeformedSurface& surface,
                          const Tracer& tracer, const Camera& camera,
                          const GuidanceParameters& parameters, PixelRect region,
                          Progress& progress);

// How far a pixel's values reach into its neighbourhood.
constexpr int guidance_margin_px() { return 2; }

// Depth discontinuity 0…1 of each pixel towards its four neighbours: clamp(14 · log(depth ratio),
// 0, 1), so that 7 % is a full silhouette; the nearer side carries it. Depth in metres along the
// ray, +inf is sky; against the sky it is 1. Only the part of the log ratio that no smooth surface
// explains counts. In perspective the *inverse* depth of a plane is linear in the picture at any
// angle, so each side's inverse depth is extrapolated linearly to the other, and the larger of the
// two predicted steps is subtracted: a second difference. A plane, a crease or the edge of a
// plateau is not a silhouette.
Grid<float> find_silhouettes(const Grid<float>& depth_m);

}  // namespace belvedere
