#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "renderer/trace/camera.h"
#include "renderer/trace/guidance.h"
#include "terrain/deform/deform.h"

namespace belvedere {

// Part of trace_guidance: what the ground says at a place (fractional column and row of the posts).

// Slope towards east (x) and north (y), rise over run: central differences at the posts (one-sided at the rim), interpolated
// bilinearly, so it is continuous and shows no facets.
glm::dvec2 sample_gradient(const Grid<float>& altitude_m, const GeoTransform& transform, double column, double row);

// The place in columns and rows where the ground seen here was before valleys were widened: what lies on it lies there.
glm::dvec2 origin_of(const TerrainModel& terrain, double column, double row);

// Everything of a pixel that depends on the place alone.
struct GroundValues {
  glm::dvec3 place{0.0};  // undeformed, scene CRS; the altitude is that of the ground that lies here, wherever it came from
  glm::vec3 normal{0.F}, normal_detail{0.F}, normal_smooth{0.F};
  float slope_deg = 0.F;
  float aspect_deg = 0.F;
  float ridge = 0.F;
  float relief_s_m = 0.F, relief_m_m = 0.F, relief_l_m = 0.F;
  float valley_height_m = 0.F;
  float rim_m = 0.F;
  float built = 0.F;
  glm::vec2 grain{0.F};
  glm::vec2 fall_line{0.F};
};
GroundValues sample_ground(const TerrainModel& terrain, const DeformedSurface& surface, const Camera& camera, double column, double row);

}  // namespace belvedere
