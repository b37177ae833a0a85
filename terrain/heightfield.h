#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "renderer/base/grid.h"

namespace belvedere {

// Max-mipmap traversal of a triangulated height field in double: an oracle for the tracer, independent of Embree. Slow and plain.
// Vertices at cell centres; each cell is split along the same diagonal as Embree's grids: (0,0)-(1,0)-(0,1) and (1,1)-(0,1)-(1,0).
class Heightfield {
 public:
  // Vertices on a regular grid in x and y (columns east, rows south), any heights.
  explicit Heightfield(const Grid<glm::vec3>& vertices);
  // Distance along the ray (direction of any length; in units of it) to the nearest facet, or nothing.
  std::optional<double> intersect(glm::dvec3 origin, glm::dvec3 direction) const;

 private:
  Grid<glm::vec3> vertices_;
  std::vector<Grid<float>> maxima_;
};

}  // namespace belvedere
