#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"
#include "base/land_cover_class.h"
#include "base/pixel_rect.h"
#include "renderer/trace/camera.h"
#include "renderer/trace/terrain_model.h"
#include "renderer/trace/tracer.h"
#include "terrain/deform/deform.h"

namespace belvedere {

// Reflections of level water: for each water pixel the ray through its centre, mirrored at the
// water as drawn (level before the ground was bent, so tilted with it), and its hit.
struct MirrorSight {
  Grid<float> cosine;  // of the angle between the eye's ray and the water's normal, 0…1; 0 where
                       // there is no water
  Grid<float> distance_m;           // from the eye to the water
  Grid<float> path_m;               // from the water to the reflected ground; +inf: the sky
  Grid<float> rise;                 // sine of the elevation angle of the mirrored ray, -1…1
  Grid<LandCoverClass> land_cover;  // of the reflected ground; sky where there is none
  Grid<float> altitude_m;           // of the reflected ground
  Grid<glm::vec3> normal;           // of the reflected ground, for lighting: of the large forms
  Grid<float> shadow;               // 1 where the sun's centre is visible from there, else 0

  int width() const { return cosine.width(); }
  int height() const { return cosine.height(); }
};

struct MirrorParameters {
  glm::dvec3 sun_direction{-0.612, 0.612, 0.5};  // unit; nothing is lit if below the horizon
  double bias_m =
      3.0;  // start of mirrored rays above the water, whose cells are not quite level; 0…100
  int tile_size = 64;  // px, does not change the result
};

// For the pixels of `region`; where `wanted` (of its size) has no mark around, none is traced. Each
// value depends only on its position on the sheet: any region gives the same bits.
MirrorSight trace_mirror(const TerrainModel& terrain, const DeformedSurface& surface,
                         const Deformation& deformation, const Tracer& tracer, const Camera& camera,
                         const MirrorParameters& parameters, const Grid<std::uint8_t>& wanted,
                         PixelRect region);

// Unit normal, in the drawn world, of water that is level at an altitude.
glm::dvec3 water_normal(const Deformation& deformation, glm::dvec3 position);

}  // namespace belvedere
