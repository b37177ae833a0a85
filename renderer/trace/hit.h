#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace belvedere {

// Where a ray met the terrain. Only the facet is Embree's answer; distance and place are computed from its posts in double, so
// they are the same on every instruction set.
struct Hit {
  bool found = false;
  double distance_m = 0.0;  // along the unit direction
  double column = 0.0;      // fractional vertex of the grid, barycentric in the undeformed grid: place before deformation
  double row = 0.0;
  int window = 0;  // of which grid: 0 the surface's own, n the n-th of its windows
  // Normal of the deformed facet towards its upper side, twice its area long: of many hits only few are asked for the unit normal.
  glm::dvec3 facet_area{0.0};

  glm::dvec3 facet_normal() const { return glm::normalize(facet_area); }
};

}  // namespace belvedere
