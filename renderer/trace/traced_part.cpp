#include "renderer/trace/traced_part.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

namespace {

// The nearest hit so far among several cells.
struct CellHit {
  double distance = std::numeric_limits<double>::infinity();
  double u = 0.0;  // in the cell, 0…1
  double v = 0.0;
  int x = 0;  // the cell
  int y = 0;
  bool lower = false;   // its south-eastern triangle
  double volume = 1.0;  // the facet's normal, twice its area long, along the ray
};

// The corners of a facet in the order of the weights: a, b for u, c for v.
struct Facet {
  std::array<glm::ivec2, 3> posts;
};
Facet facet_of(const TracedPart& part, int x, int y, bool lower) {
  const int near = lower ? 1 : 0;  // the triangle's right angle is at post (x + near, y + near)
  const int far = 1 - near;
  return {{part.met(x + near, y + near), part.met(x + far, y + near), part.met(x + near, y + far)}};
}

// A ray (origin o relative to the surface's, direction d) against one triangle of a cell, in
// double. Sides are signs of the volumes that the ray's line spans with each edge; an edge shared
// by two triangles gives both the same volume with opposite sign, so no ray slips between them.
// `clamped`: a ray that misses it gets its nearest point instead.
inline void intersect_facet(const TracedPart& part, int x, int y, bool lower, const glm::dvec3& o,
                            const glm::dvec3& d, CellHit& best, bool clamped = false) {
  const Facet facet = facet_of(part, x, y, lower);
  const glm::dvec3 a = part.post(facet.posts[0].x, facet.posts[0].y) - o;
  const glm::dvec3 b = part.post(facet.posts[1].x, facet.posts[1].y) - o;
  const glm::dvec3 c = part.post(facet.posts[2].x, facet.posts[2].y) - o;
  const double ab = glm::dot(glm::cross(a, b), d);  // weight of c, and so on
  const double bc = glm::dot(glm::cross(b, c), d);
  const double ca = glm::dot(glm::cross(c, a), d);
  const double sum = ab + bc + ca;
  const bool beside = std::min(ab, std::min(bc, ca)) < 0.0 && std::max(ab, std::max(bc, ca)) > 0.0;
  if ((beside && !clamped) || sum == 0.0) return;  // 0: seen edge-on
  const double share = 1.0 / sum;
  double wb = ca * share;
  double wc = ab * share;
  if (clamped) {
    wb = std::clamp(wb, 0.0, 1.0);
    wc = std::clamp(wc, 0.0, 1.0 - wb);
  }
  const double distance = glm::dot(a + (b - a) * wb + (c - a) * wc, d);
  if (!(distance >= 0.0) || !(distance < best.distance)) return;
  best = {distance, lower ? 1.0 - wb : wb, lower ? 1.0 - wc : wc, x, y, lower, sum};
}

glm::dvec3 facet_area(const TracedPart& part, const CellHit& hit) {
  const Facet facet = facet_of(part, hit.x, hit.y, hit.lower);
  const auto edge = [&](std::size_t to) {
    return part.post(facet.posts[to].x, facet.posts[to].y) -
           part.post(facet.posts[0].x, facet.posts[0].y);
  };
  const glm::dvec3 east = hit.lower ? -edge(1) : edge(1);
  const glm::dvec3 south = hit.lower ? -edge(2) : edge(2);
  return glm::cross(south, east);
}

// Column and row of a hit. Where a post of the cell is skipped, interpolates between those that are
// not.
glm::dvec2 position_of(const TracedPart& part, const CellHit& hit) {
  const Facet facet = facet_of(part, hit.x, hit.y, hit.lower);
  const int near = hit.lower ? 1 : 0;
  if (!part.is_window || (facet.posts[0] == glm::ivec2(hit.x + near, hit.y + near) &&
                          facet.posts[1] == glm::ivec2(hit.x + 1 - near, hit.y + near) &&
                          facet.posts[2] == glm::ivec2(hit.x + near, hit.y + 1 - near)))
    return {hit.x + hit.u, hit.y + hit.v};
  const double wb = hit.lower ? 1.0 - hit.u : hit.u;
  const double wc = hit.lower ? 1.0 - hit.v : hit.v;
  return (1.0 - wb - wc) * glm::dvec2(facet.posts[0]) + wb * glm::dvec2(facet.posts[1]) +
         wc * glm::dvec2(facet.posts[2]);
}

}  // namespace

bool resolve_facet(const TracedPart& part, const GridTile& tile, glm::vec2 in_tile, const Ray& ray,
                   Hit& hit) {
  const float fx = in_tile.x * static_cast<float>(tile.cells_x);
  const float fy = in_tile.y * static_cast<float>(tile.cells_y);
  const int x = tile.x0 + std::clamp(static_cast<int>(fx), 0, tile.cells_x - 1);
  const int y = tile.y0 + std::clamp(static_cast<int>(fy), 0, tile.cells_y - 1);
  CellHit best;
  const float in_x = fx - static_cast<float>(x - tile.x0);
  const float in_y = fy - static_cast<float>(y - tile.y0);
  const bool lower = in_x + in_y > 1.F;
  intersect_facet(part, x, y, lower, ray.origin, ray.direction, best);
  // Embree's float positions are off by the rounding of volumes of about distance × side of a cell,
  // relative to the facet's own. So near an edge, and where the facet is missed, its neighbours are
  // tested too, and the nearest hit is taken, whichever facet Embree reported. 16 roundings exceed
  // those in its sums.
  constexpr double rounding = 16.0 * 0x1.0p-24;
  const double volume = std::abs(best.volume);
  const double rim =
      std::min(0.5 * volume, rounding * best.distance *
                                 part.side);  // times the volume, which saves a division per ray
  const auto within_rim = [&](double share) { return share * volume < rim; };
  const bool missed = !(best.distance < std::numeric_limits<double>::infinity());
  const double to_edge = std::min(std::min(best.u, best.v), 1.0 - std::max(best.u, best.v));
  if (missed || within_rim(std::min(to_edge, std::abs(best.u + best.v - 1.0)))) {
    const int x0 = missed || within_rim(best.u) ? x - 1 : x;
    const int x1 = missed || within_rim(1.0 - best.u) ? x + 1 : x;
    const int y0 = missed || within_rim(best.v) ? y - 1 : y;
    const int y1 = missed || within_rim(1.0 - best.v) ? y + 1 : y;
    for (int cy = y0; cy <= y1; ++cy) {
      for (int cx = x0; cx <= x1; ++cx) {
        if (!part.has_cell(cx, cy)) continue;
        intersect_facet(part, cx, cy, false, ray.origin, ray.direction, best);
        intersect_facet(part, cx, cy, true, ray.origin, ray.direction, best);
      }
    }
    if (!(best.distance < std::numeric_limits<double>::infinity())) {
      // Beyond the edge is another part. Continuing along the ray could miss both, as their
      // distances differ by rounding alone.
      if (!part.at_joint(x, y)) return false;
      intersect_facet(part, x, y, lower, ray.origin, ray.direction, best, true);
      if (!(best.distance < std::numeric_limits<double>::infinity())) return false;
    }
  }
  const glm::dvec2 position = position_of(part, best);
  hit.found = true;
  hit.distance_m = best.distance;
  hit.column = position.x;
  hit.row = position.y;
  hit.facet_area = facet_area(part, best);
  return true;
}

glm::dvec3 on_facet(const Grid<glm::vec3>& posts, glm::dvec2 at) {
  const int x = std::clamp(static_cast<int>(at.x), 0, posts.width() - 2);
  const int y = std::clamp(static_cast<int>(at.y), 0, posts.height() - 2);
  const double fx = at.x - x;
  const double fy = at.y - y;
  const glm::dvec3 ne(posts(x + 1, y));
  const glm::dvec3 sw(posts(x, y + 1));
  if (fx + fy <= 1.0) {
    const glm::dvec3 nw(posts(x, y));
    return nw + (ne - nw) * fx + (sw - nw) * fy;
  }
  const glm::dvec3 se(posts(x + 1, y + 1));
  return se + (sw - se) * (1.0 - fx) + (ne - se) * (1.0 - fy);
}

}  // namespace belvedere
