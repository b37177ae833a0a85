#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "renderer/base/grid.h"
#include "terrain/raster.h"

namespace belvedere {

// Progressive bending: z' = e z - (d - crest)² / (2 radius) - [d > far_from] far_amount (d - far_from)², e the exaggeration and d the
// horizontal distance from the viewer. The foreground turns towards the viewer, the far ground sinks to the horizon. Both
// terms bend a level plain downwards: by 1 / radius everywhere, by 2 far_amount more beyond far_from, where height and slope are
// continuous.
struct BendCurve {
  double radius_m = 0.0;          // 0: no parabola; else 1000…1e9
  double crest_m = 0.0;           // distance where the ground is level
  double far_from_m = 0.0;        // ≥ 0
  double far_amount_per_m = 0.0;  // ≥ 0, 1/m
};

struct DeformParameters {
  double exaggeration = 1.0;  // 0.1…10, of all altitudes
  BendCurve bend;
  bool earth_curvature = false;  // with refraction: z -= d² (1 - k) / (2 · 6371 km), not exaggerated
  double refraction = 0.13;      // k, 0…0.5
};

// Drop of the ground at horizontal distance d ≥ 0, m (positive is down): bend and earth curvature.
double bend_drop_m(const DeformParameters& parameters, double distance_m);

// Vertices that moved in three dimensions; vertex (x, y) belongs to cell centre (x, y) of the DEM and so keeps its undeformed
// place. Positions are relative to `origin`, subtracted in double before they become float.
struct DeformedSurface {
  Grid<glm::vec3> vertices_m;
  glm::dvec3 origin;
};

// viewer_xy: the eye in the DEM's CRS. origin: usually the eye's place at altitude 0.
DeformedSurface deform(const Grid<float>& altitude_m, const GeoTransform& transform, glm::dvec2 viewer_xy, glm::dvec3 origin,
                       const DeformParameters& parameters);
// The same for one point, in the same arithmetic (a vertex differs by the rounding to float alone): x, y, altitude in, place in the
// deformed world (not relative to an origin) out.
glm::dvec3 deform_point(glm::dvec3 point, glm::dvec2 viewer_xy, const DeformParameters& parameters);

}  // namespace belvedere
