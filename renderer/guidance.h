#pragma once

#include <glm/vec3.hpp>
#include <string>

#include "renderer/base/guidance_buffers.h"
#include "renderer/base/parallel.h"
#include "renderer/base/progress.h"
#include "renderer/camera.h"
#include "renderer/tracer.h"
#include "terrain/dem.h"
#include "terrain/land_cover.h"

namespace belvedere {

// All the ground values a pixel may ask for, made once from the DEM; every grid has the DEM's size.
struct TerrainModel {
  Dem dem;                        // undeformed, ungeneralized
  Grid<float> generalized_m;      // after generalize()
  Grid<float> detail_smooth_m;    // dem after a Gaussian of 60 m: slope and aspect
  Grid<float> shape_smooth_m;     // generalized after a Gaussian of 120 m: normal_smooth, fall line
  Grid<float> relief_s_m, relief_m_m, relief_l_m;
  Grid<float> valley_height_m;
  LandCover land_cover;
  double exaggeration = 1.0;      // of light's normals
  double detail_boost = 1.5;      // further exaggeration of normal_detail (look/recipe.md: slopes × 1.6 × 1.5)
};

// Makes the derived grids from dem, generalized and land cover.
TerrainModel make_terrain_model(Dem dem, Grid<float> generalized_m, LandCover land_cover, double exaggeration);

struct GuidanceParameters {
  int pixel_samples = 4;             // primary rays a pixel, 1, 4, 9 or 16
  int shadow_rays = 8;               // towards the sun's disc, 1…64
  int sky_directions = 16;           // fixed directions, cosine weighted, 0 (sky view 1)…256
  double sky_reach_m = 12000.0;      // beyond that nothing hides the sky
  double shadow_bias_m = 0.05;       // start of secondary rays above the facet
  glm::dvec3 sun_direction{-0.612, 0.612, 0.5};  // unit, towards the sun (x east, y north, z up)
  double sun_radius_rad = 0.03;      // radius of the disc: softness of cast shadows
  int tile_size = 32;                // px; changes no bit of the result
};

// Traces a rectangle of the picture: all channels but tone and base (those are renderer/light's and renderer/palette's). Any
// split of the picture into rectangles gives the same values except silhouette and what else looks at neighbours, for which
// `region` must carry a margin of guidance_margin_px().
GuidanceBuffers trace_guidance(const TerrainModel& terrain, const DeformedSurface& surface, const Tracer& tracer, const Camera& camera,
                               const GuidanceParameters& parameters, PixelRect region, Progress& progress);

}  // namespace belvedere
