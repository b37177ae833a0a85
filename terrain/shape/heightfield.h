#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// Max-mipmap traversal of a triangulated height field in double: an oracle for the tracer, independent of Embree. Slow and plain.
// Vertices at cell centres; each cell is split along the same diagonal as Embree's grids: (0,0)-(1,0)-(0,1) and (1,1)-(0,1)-(1,0).
class Heightfield {
 public:
  // Vertices on a regular grid in x and y (columns east, rows south), any heights; small irregularities, such as rounding to
  // float, are allowed for. Facets with a vertex that is not finite do not exist. At least 2×2 vertices, else Error(bug).
  explicit Heightfield(const Grid<glm::vec3>& vertices);
  // Distance along the ray (direction of any length; in units of it) to the nearest facet from either side, or nothing.
  // No ray falls through an edge or a vertex that facets share.
  std::optional<double> intersect(glm::dvec3 origin, glm::dvec3 direction) const;

 private:
  struct Ray;
  void visit(const Ray& ray, int level, int x, int y, double& nearest) const;

  Grid<glm::vec3> vertices_;
  std::vector<glm::dvec2> column_x_;  // smallest and largest x of each column of vertices
  std::vector<glm::dvec2> row_y_;     // smallest and largest y of each row of vertices
  std::vector<Grid<float>> maxima_;   // highest z of a cell (level 0), of 2×2 cells (level 1), …; the last is one block
};

}  // namespace belvedere
