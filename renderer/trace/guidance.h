#pragma once

#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/terrain_model.h"
#include "renderer/trace/tracer.h"
#include "terrain/deform/deform.h"

namespace belvedere {

struct GuidanceParameters {
  int pixel_samples = 4;  // primary rays a pixel, 1, 4, 9 or 16
  int shadow_rays = 8;    // towards the sun's disc, 1…64; blocks of pixels with no penumbra get by with two
  // Cosine-weighted directions that 2 × 2 pixels share, 0 (sky view 1)…256: each pixel traces a quarter of them, each of the 16
  // pixels of a 4 × 4 square others, and the mean over such a square is the pixel's sky view.
  int sky_directions = 16;
  double sky_reach_m = 12000.0;                  // beyond that nothing hides the sky, 1…1e6
  double shadow_bias_m = 0.05;                   // start of secondary rays above the facet, 0…100
  glm::dvec3 sun_direction{-0.612, 0.612, 0.5};  // unit, towards the sun (x east, y north, z up); z <= 0: all terrain in shadow
  double sun_radius_rad = 0.03;                  // radius of the disc: softness of cast shadows, 0…0.5
  int tile_size = 32;                            // px, 8…4096; changes no bit of the result
};

// Traces a rectangle of the picture: the channels whose maker is ChannelMaker::trace (base/guidance_channels.h). The buffers have the
// rectangle's size. position_m is relative to surface.origin, which becomes origin_m.
// ridge is relief_s / (|relief_s| + 10 m), -1…1. Terrain without a known class counts as rock. Any split of the picture into
// rectangles gives the same bits, except silhouette and sky_view, which look at neighbours: they need a margin of guidance_margin_px().
// terrain and surface have the same posts. Throws Error(usage) for parameters out of range, naming the scene's key.
GuidanceBuffers trace_guidance(const TerrainModel& terrain, const DeformedSurface& surface, const Tracer& tracer, const Camera& camera,
                               const GuidanceParameters& parameters, PixelRect region, Progress& progress);

// How far a pixel's values reach into its neighbourhood.
constexpr int guidance_margin_px() { return 2; }

}  // namespace belvedere
