#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>

#include "base/guidance_buffers.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/tracer.h"
#include "terrain/cover/floor_plan.h"
#include "terrain/cover/land_cover.h"
#include "terrain/deform/deform.h"
#include "terrain/io/dem.h"

namespace belvedere {

// All the ground values a pixel may ask for, made once from the DEM; every grid has the DEM's size.
struct TerrainModel {
  std::shared_ptr<const Dem> dem;                  // undeformed, ungeneralized
  Grid<float> generalized_m;                       // after generalize()
  Grid<glm::vec2> came_from;                       // where widening of valleys took each cell's ground from, columns and rows; may be empty
  Grid<float> detail_smooth_m;                     // dem after a Gaussian of 60 m: slope and aspect
  Grid<float> shape_smooth_m;                      // generalized after a Gaussian of 120 m: normal_smooth, fall line
  Grid<float> relief_s_m, relief_m_m, relief_l_m;  // z(30 m) - z(180 m), z(30 m) - z(750 m), z(120 m) - z(1800 m)
  Grid<float> valley_height_m;                     // above the lowest ground within 900 m
  Grid<float> rim_m;                               // distance to where the known terrain ends
  std::shared_ptr<const LandCover> land_cover;
  FloorPlan floor_plan;       // how valley floors are laid out
  double exaggeration = 1.0;  // of light's normals
  // Given where the ground is not only exaggerated alike everywhere: then light's normals are those of the rearranged shape.
  std::optional<Deformation> local;
  double detail_boost = 1.5;  // further exaggeration of normal_detail (look/recipe.md: slopes × 1.6 × 1.5)
};

// Makes the derived grids from dem, generalized and land cover. Throws Error(bug) where the two grids differ in size.
TerrainModel make_terrain_model(std::shared_ptr<const Dem> dem, Grid<float> generalized_m, std::shared_ptr<const LandCover> land_cover,
                                double exaggeration);

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

// Traces a rectangle of the picture: all channels but tone and base (those are renderer/light's and renderer/palette's). The
// buffers have the rectangle's size. position_m is relative to surface.origin, which becomes origin_m.
// ridge is relief_s / (|relief_s| + 10 m), -1…1. Terrain without a known class counts as rock. Any split of the picture into
// rectangles gives the same bits, except silhouette and sky_view, which look at neighbours: they need a margin of guidance_margin_px().
// terrain and surface have the same posts. Throws Error(usage) for parameters out of range, naming the scene's key.
GuidanceBuffers trace_guidance(const TerrainModel& terrain, const DeformedSurface& surface, const Tracer& tracer, const Camera& camera,
                               const GuidanceParameters& parameters, PixelRect region, Progress& progress);

// How far a pixel's values reach into its neighbourhood.
constexpr int guidance_margin_px() { return 2; }

}  // namespace belvedere
