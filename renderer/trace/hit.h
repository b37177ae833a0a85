#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace belvedere {

// Where a ray hit the terrain. Embree gives only the facet; distance and position are computed from
// its posts in double, so they are the same on every instruction set.
struct Hit {
  bool found = false;
  double distance_m = 0.0;  // along the unit direction
  double column = 0.0;      // fractional vertex of the grid, barycentric in the undeformed grid:
                            // position before deformation
  double row = 0.0;
  int window = 0;  // grid index: 0 the surface's own, n its n-th window
  // Normal of the deformed facet towards its upper side, of length twice its area: the unit normal
  // is needed for few hits only.
  glm::dvec3 facet_area{0.0};

  glm::dvec3 facet_normal() const { return glm::normalize(facet_area); }
};

}  // namespace belvedere
