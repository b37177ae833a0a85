#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"
#include "terrain/deform/deform.h"

namespace belvedere {

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

}  // namespace belvedere
