#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/grid.h"
#include "tests/grids.h"

namespace belvedere::test {
namespace heightfield {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

// The part of a ray, from `enter` to `leave`.
struct Interval {
  double enter = 0.0;
  double leave = infinity;
};

// Narrows the interval to where low <= origin + t direction <= high.
inline void clip_to_slab(Interval& interval, double origin, double direction, double low,
                         double high) {
  if (direction == 0.0) {
    if (origin < low || origin > high) interval.leave = -infinity;
    return;
  }
  const double a = (low - origin) / direction;
  const double b = (high - origin) / direction;
  interval.enter = std::max(interval.enter, std::min(a, b));
  interval.leave = std::min(interval.leave, std::max(a, b));
}

// The ray's own frame: the axis of its largest component, and the shears that lay the ray along it.
struct Shear {
  int x;
  int y;
  int z;
  double by_x;
  double by_y;
};

inline Shear make_shear(glm::dvec3 direction) {
  const glm::dvec3 size = glm::abs(direction);
  const int z = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const int x = (z + 1) % 3;
  const int y = (z + 2) % 3;
  return {x, y, z, direction[x] / direction[z], direction[y] / direction[z]};
}

// The point, relative to the ray's origin, in the plane that the ray crosses at (0, 0).
inline glm::dvec2 flatten(const Shear& shear, glm::dvec3 p) {
  return {p[shear.x] - shear.by_x * p[shear.z], p[shear.y] - shear.by_y * p[shear.z]};
}

// After Woop, Benthin & Wald 2013. A vertex is projected once, the same for all its facets.
// Rounding of a product is monotonic, so the sign of an edge below is right or zero; zero counts as
// inside, so a ray cannot slip between facets at an edge or a vertex.
inline double intersect_facet(const Shear& shear, glm::dvec3 direction, glm::dvec3 a, glm::dvec3 b,
                              glm::dvec3 c) {
  const glm::dvec2 fa = flatten(shear, a);
  const glm::dvec2 fb = flatten(shear, b);
  const glm::dvec2 fc = flatten(shear, c);
  const double u = fc.x * fb.y - fc.y * fb.x;
  const double v = fa.x * fc.y - fa.y * fc.x;
  const double w = fb.x * fa.y - fb.y * fa.x;
  if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) return infinity;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double along = glm::dot(direction, normal);
  if (along == 0.0) return infinity;  // in the facet's plane: a neighbour or nothing is hit
  const double distance = glm::dot(a, normal) / along;
  return distance >= 0.0 ? distance : infinity;
}

inline bool is_finite(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

}  // namespace heightfield

// Max-mipmap traversal of a triangulated height field in double: an oracle for the tracer,
// independent of Embree. Slow and simple. Vertices at cell centres; each cell is split along the
// same diagonal as Embree's grids: (0,0)-(1,0)-(0,1) and (1,1)-(0,1)-(1,0).
class Heightfield {
 public:
  // Vertices on a regular grid in x and y (columns east, rows south), any heights; small
  // irregularities, such as rounding to float, are allowed for. Facets with a vertex that is not
  // finite do not exist. At least 2×2 vertices.
  explicit Heightfield(const Grid<glm::vec3>& vertices);
  // Distance along the ray (direction of any length; in units of it) to the nearest facet from
  // either side, or nothing. No ray falls through an edge or a vertex that facets share.
  std::optional<double> intersect(glm::dvec3 origin, glm::dvec3 direction) const;

 private:
  struct Ray;
  void visit(const Ray& ray, int level, int x, int y, double& nearest) const;

  Grid<glm::vec3> vertices_;
  std::vector<glm::dvec2> column_x_;  // smallest and largest x of each column of vertices
  std::vector<glm::dvec2> row_y_;     // smallest and largest y of each row of vertices
  std::vector<Grid<float>>
      maxima_;  // highest z of a cell (level 0), of 2×2 cells (level 1), …; the last is one block
};

struct Heightfield::Ray {
  glm::dvec3 origin;
  glm::dvec3 direction;
  heightfield::Shear shear;
};

inline Heightfield::Heightfield(const Grid<glm::vec3>& vertices) : vertices_(vertices) {
  const int width = vertices.width();
  const int height = vertices.height();
  if (width < 2 || height < 2)
    throw std::invalid_argument("a heightfield of fewer than 2 x 2 vertices");
  column_x_.assign(static_cast<std::size_t>(width),
                   glm::dvec2(heightfield::infinity, -heightfield::infinity));
  row_y_.assign(static_cast<std::size_t>(height),
                glm::dvec2(heightfield::infinity, -heightfield::infinity));
  for (const auto [x, y] : test::cells(width, height)) {
    const glm::dvec3 p(vertices(x, y));
    if (!heightfield::is_finite(p)) continue;
    glm::dvec2& column = column_x_[static_cast<std::size_t>(x)];
    glm::dvec2& row = row_y_[static_cast<std::size_t>(y)];
    column = {std::min(column.x, p.x), std::max(column.y, p.x)};
    row = {std::min(row.x, p.y), std::max(row.y, p.y)};
  }

  constexpr float lowest = -std::numeric_limits<float>::infinity();
  Grid<float> cells(width - 1, height - 1, lowest);
  for (int y = 0; y + 1 < height; ++y)
    for (int x = 0; x + 1 < width; ++x)
      for (const glm::vec3& p :
           {vertices(x, y), vertices(x + 1, y), vertices(x, y + 1), vertices(x + 1, y + 1)})
        if (heightfield::is_finite(p)) cells(x, y) = std::max(cells(x, y), p.z);
  maxima_.push_back(std::move(cells));
  while (maxima_.back().size() > 1) {
    const Grid<float>& fine = maxima_.back();
    Grid<float> coarse((fine.width() + 1) / 2, (fine.height() + 1) / 2, lowest);
    for (const auto [x, y] : test::cells(fine))
      coarse(x / 2, y / 2) = std::max(coarse(x / 2, y / 2), fine(x, y));
    maxima_.push_back(std::move(coarse));
  }
}

// A block of 2^level cells a side, its first at (x << level, y << level).
inline void Heightfield::visit(const Ray& ray, int level, int x, int y, double& nearest) const {
  const Grid<float>& maxima = maxima_[static_cast<std::size_t>(level)];
  if (!maxima.contains(x, y)) return;
  const auto first_x = static_cast<std::size_t>(x) << level;
  const auto first_y = static_cast<std::size_t>(y) << level;
  const std::size_t last_x =
      std::min((static_cast<std::size_t>(x) + 1) << level, column_x_.size() - 1);
  const std::size_t last_y =
      std::min((static_cast<std::size_t>(y) + 1) << level, row_y_.size() - 1);
  const auto [west, east] = std::minmax(
      {column_x_[first_x].x, column_x_[last_x].x, column_x_[first_x].y, column_x_[last_x].y});
  const auto [south, north] =
      std::minmax({row_y_[first_y].x, row_y_[last_y].x, row_y_[first_y].y, row_y_[last_y].y});
  heightfield::Interval interval{0.0, nearest};
  heightfield::clip_to_slab(interval, ray.origin.x, ray.direction.x, west, east);
  heightfield::clip_to_slab(interval, ray.origin.y, ray.direction.y, south, north);
  heightfield::clip_to_slab(interval, ray.origin.z, ray.direction.z, -heightfield::infinity,
                            static_cast<double>(maxima(x, y)));
  // Slabs are computed with rounding, so a block that is narrowly missed is visited as well.
  if (interval.enter - interval.leave > 1e-9 * (1.0 + interval.enter)) return;

  if (level > 0) {
    // Near children first: rays to the east meet the western ones first, rays to the south (falling
    // y) the northern ones.
    const int flip_x = ray.direction.x < 0.0 ? 1 : 0;
    const int flip_y = ray.direction.y > 0.0 ? 1 : 0;
    for (int child = 0; child < 4; ++child)
      visit(ray, level - 1, 2 * x + ((child & 1) ^ flip_x), 2 * y + ((child >> 1) ^ flip_y),
            nearest);
    return;
  }
  const auto relative = [&](int column, int row) {
    return glm::dvec3(vertices_(column, row)) - ray.origin;
  };
  const glm::dvec3 p00 = relative(x, y);
  const glm::dvec3 p10 = relative(x + 1, y);
  const glm::dvec3 p01 = relative(x, y + 1);
  const glm::dvec3 p11 = relative(x + 1, y + 1);
  if (!heightfield::is_finite(p10) || !heightfield::is_finite(p01)) return;
  if (heightfield::is_finite(p00))
    nearest =
        std::min(nearest, heightfield::intersect_facet(ray.shear, ray.direction, p00, p10, p01));
  if (heightfield::is_finite(p11))
    nearest =
        std::min(nearest, heightfield::intersect_facet(ray.shear, ray.direction, p11, p01, p10));
}

inline std::optional<double> Heightfield::intersect(glm::dvec3 origin, glm::dvec3 direction) const {
  double nearest = heightfield::infinity;
  visit({origin, direction, heightfield::make_shear(direction)},
        static_cast<int>(maxima_.size()) - 1, 0, 0, nearest);
  if (nearest == heightfield::infinity) return std::nullopt;
  return nearest;
}

}  // namespace belvedere::test
