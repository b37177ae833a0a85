#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "renderer/trace/camera.h"
#include "terrain/deform/deform.h"

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

// Cells passed to the tracer's structure together: their first post and their number.
struct GridTile {
  int x0, y0, cells_x, cells_y;
};

// One traced grid of posts: the surface's own or that of a window.
struct TracedPart {
  const Grid<glm::vec3>* posts = nullptr;
  PixelRect traced;  // posts whose cells are traced, except those of the hole
  PixelRect hole;    // posts around cells that a window replaces; may be empty
  bool is_window = false;
  double side = 0.0;  // of a cell, approximately
  std::vector<GridTile>
      tiles;  // a window's all in one geometry; the surface's last one in its own geometry

  // The post used for (x, y): along a window's edge, posts that the coarser side lacks are skipped.
  glm::ivec2 met(int x, int y) const {
    if (is_window) {
      if (y == traced.y0 || y == traced.y1 - 1) x -= (x - traced.x0) & 1;
      if (x == traced.x0 || x == traced.x1 - 1) y -= (y - traced.y0) & 1;
    }
    return {x, y};
  }
  glm::dvec3 post(int x, int y) const { return glm::dvec3((*posts)(x, y)); }
  bool has_cell(int x, int y) const {
    const bool inside = x >= traced.x0 && y >= traced.y0 && x + 1 < traced.x1 && y + 1 < traced.y1;
    return inside && !in_hole(x, y);
  }
  bool in_hole(int x, int y) const {
    return x >= hole.x0 && y >= hole.y0 && x + 1 < hole.x1 && y + 1 < hole.y1;
  }
  // Whether a cell touches another part.
  bool at_joint(int x, int y) const {
    if (is_window && (x <= traced.x0 || y <= traced.y0 || x + 2 >= traced.x1 || y + 2 >= traced.y1))
      return true;
    return !hole.empty() && x >= hole.x0 - 1 && y >= hole.y0 - 1 && x < hole.x1 && y < hole.y1;
  }
};

// The surface's own grid and its windows, the traced part of each, and its tiles of up to
// `tile_cells` squared. The posts stay the surface's. Throws Error(bug) for a window outside the
// surface before it.
std::vector<TracedPart> make_traced_parts(const DeformedSurface& surface, int tile_cells);

// The exact hit, in double, from the facet that float tracing reported: `in_tile` is its position
// in the tile, 0…1. The ray's origin is relative to the surface's. Fills all of `hit` but its
// window. False where in double the ray misses the facet (it grazed an edge).
bool resolve_facet(const TracedPart& part, const GridTile& tile, glm::vec2 in_tile, const Ray& ray,
                   Hit& hit);

// A position on a surface, column and row within its posts: on one of the two triangles of its
// cell, whose common side runs from north-east to south-west.
glm::dvec3 on_facet(const Grid<glm::vec3>& posts, glm::dvec2 at);

}  // namespace belvedere
