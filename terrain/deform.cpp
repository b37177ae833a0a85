#include "terrain/deform.h"

#include <cmath>

#include "renderer/base/parallel.h"

namespace belvedere {
namespace {

constexpr double earth_radius_m = 6371.0e3;

}  // namespace

double bend_drop_m(const DeformParameters& parameters, double distance_m) {
  const BendCurve& bend = parameters.bend;
  double drop = 0.0;
  if (bend.radius_m > 0.0) {
    const double from_crest = distance_m - bend.crest_m;
    drop += from_crest * from_crest / (2.0 * bend.radius_m);
  }
  if (distance_m > bend.far_from_m) {
    const double beyond = distance_m - bend.far_from_m;
    drop += bend.far_amount_per_m * beyond * beyond;
  }
  if (parameters.earth_curvature) {
    // A ray bent down by refraction sees an earth whose radius is larger by 1 / (1 - k).
    drop += distance_m * distance_m * (1.0 - parameters.refraction) / (2.0 * earth_radius_m);
  }
  return drop;
}

glm::dvec3 deform_point(glm::dvec3 point, glm::dvec2 viewer_xy, const DeformParameters& parameters) {
  const double east = point.x - viewer_xy.x;
  const double north = point.y - viewer_xy.y;
  const double distance = std::sqrt(east * east + north * north);
  return {point.x, point.y, point.z * parameters.exaggeration - bend_drop_m(parameters, distance)};
}

DeformedSurface deform(const Grid<float>& altitude_m, const GeoTransform& transform, glm::dvec2 viewer_xy, glm::dvec3 origin,
                       const DeformParameters& parameters) {
  DeformedSurface surface{Grid<glm::vec3>(altitude_m.width(), altitude_m.height()), origin};
  parallel_rows(altitude_m.height(), [&](int y) {
    for (int x = 0; x < altitude_m.width(); ++x) {
      const glm::dvec2 place = transform.to_crs(x, y);
      const glm::dvec3 moved = deform_point({place.x, place.y, altitude_m(x, y)}, viewer_xy, parameters);
      surface.vertices_m(x, y) = glm::vec3(moved - origin);
    }
  });
  return surface;
}

}  // namespace belvedere
