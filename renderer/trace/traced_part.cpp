#include "renderer/trace/traced_part.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "base/error.h"
#include "base/math_exact.h"

namespace belvedere {
namespace {

// The cells between posts outside the hole, as up to four rectangles, the last of which contains
// the last post.
std::vector<PixelRect> without_hole(const PixelRect& posts, const PixelRect& hole) {
  if (hole.empty()) return {posts};
  return {{posts.x0, posts.y0, posts.x1, hole.y0 + 1},
          {posts.x0, hole.y0, hole.x0 + 1, hole.y1},
          {hole.x1 - 1, hole.y0, posts.x1, hole.y1},
          {posts.x0, hole.y1 - 1, posts.x1, posts.y1}};
}

void make_tiles(TracedPart& part, int tile_cells) {
  for (const PixelRect& posts : without_hole(part.traced, part.hole)) {
    for (int y = posts.y0; y + 1 < posts.y1; y += tile_cells)
      for (int x = posts.x0; x + 1 < posts.x1; x += tile_cells)
        part.tiles.push_back(
            {x, y, std::min(tile_cells, posts.x1 - 1 - x), std::min(tile_cells, posts.y1 - 1 - y)});
  }
}

}  // namespace

std::vector<TracedPart> make_traced_parts(const DeformedSurface& surface, int tile_cells) {
  const auto side_of = [](const Grid<glm::vec3>& posts) {
    const glm::dvec3 across =
        glm::dvec3(posts(posts.width() - 1, posts.height() - 1)) - glm::dvec3(posts(0, 0));
    return glm::length(across) / exact::hypot(posts.width() - 1.0, posts.height() - 1.0);
  };
  const Grid<glm::vec3>& own = surface.vertices_m;
  std::vector<TracedPart> parts;
  parts.push_back({&own, {0, 0, own.width(), own.height()}, {}, false, side_of(own), {}});
  for (const SurfaceWindow& window : surface.windows) {
    const Grid<glm::vec3>& posts = window.surface.vertices_m;
    const PixelRect& part = window.part;
    const bool fits =
        part.width() == 2 * window.replaces.width() - 1 &&
        part.height() == 2 * window.replaces.height() - 1 &&
        std::min(part.width(), part.height()) >= 5 && part.x1 < posts.width() &&
        part.y1 < posts.height() &&
        intersection(grown(window.replaces, 1), parts.back().traced) == grown(window.replaces, 1);
    if (!fits)
      throw Error(ErrorKind::bug, "ray tracing", "a window lies outside the surface before it");
    parts.back().hole = window.replaces;
    parts.push_back({&posts, part, {}, true, side_of(posts), {}});
  }
  for (TracedPart& part : parts) make_tiles(part, tile_cells);
  return parts;
}

}  // namespace belvedere
