#include "renderer/labels/label_marks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "base/filter.h"
#include "base/parallel.h"

namespace belvedere {
namespace {

// How far above a mark sky must be visible for it to be on the skyline, px: a summit's own vertices
// lie on the line itself.
constexpr double sky_over_px = 1.5;
// Radius of the search for higher ground: boulders of a fine DEM are not summits.
constexpr int step_cells = 3;

// A cell with its position in the picture.
struct SeenCell {
  glm::ivec2 cell{0};
  ImagePosition at;
};

// The upper edge of a summit as drawn. Seen from high above, ground behind the top may still be
// drawn above it: from the top one goes to the highest visible position in the picture among the
// nearest cells, while the ground falls. Where it rises again, or the path leaves the search
// radius, the slope belongs to the ground behind, and the edge is the top itself.
ImagePosition upper_edge(const LocatedGround& ground, glm::dvec2 start, glm::dvec2 top,
                         const ImagePosition& seen_top, double max_m) {
  const Grid<float>& z = ground.generalized_m;
  const glm::dvec2 from = ground.transform.to_cell(top.x, top.y);
  SeenCell here{{static_cast<int>(std::lround(from.x)), static_cast<int>(std::lround(from.y))},
                seen_top};
  while (true) {
    SeenCell next = here;
    for (int dy = -step_cells; dy <= step_cells; ++dy)
      for (int dx = -step_cells; dx <= step_cells; ++dx) {
        const glm::ivec2 cell = here.cell + glm::ivec2(dx, dy);
        if (!z.contains(cell.x, cell.y)) continue;
        const std::optional<ImagePosition> at =
            ground.map.drawn_to_image(ground.transform.to_crs(cell.x, cell.y));
        if (at && at->visible && at->pixel.y < next.at.pixel.y) next = {cell, *at};
      }
    if (next.cell == here.cell) return here.at;
    const bool rises = z(next.cell.x, next.cell.y) > z(here.cell.x, here.cell.y);
    if (rises || glm::length(ground.transform.to_crs(next.cell.x, next.cell.y) - start) > max_m)
      return seen_top;
    here = next;
  }
}

LabelMark find_mark(const LocatedGround& ground, const LabelPoint& point,
                    const LabelKindStyle& kind) {
  LabelMark mark;
  mark.drawn_position = point.position;
  mark.dem_altitude_m = NAN;
  const glm::dvec2 start = ground.map.drawn_position(point.position);
  const std::optional<glm::dvec2> drawn =
      kind.climb_m > 0.0 ? climb(ground, start, kind.climb_m) : std::optional<glm::dvec2>(start);
  if (!drawn) return mark;
  const glm::dvec2 position = ground.map.position_of_drawn(*drawn);
  if (!ground.map.on_surface(position)) return mark;
  mark.drawn_position = position;
  const glm::dvec2 cell = ground.transform.to_cell(position.x, position.y);
  // Between cells as in the profiles of tracks; at the centre of a cell, as of a top, its own
  // value.
  mark.dem_altitude_m = static_cast<double>(sample_bilinear(ground.altitude_m, cell.x, cell.y));
  std::optional<ImagePosition> at = ground.map.drawn_to_image(*drawn);
  if (!at) {
    mark.state = MarkState::behind_eye;
    return mark;
  }
  if (kind.climb_m > 0.0 && at->visible) at = upper_edge(ground, start, *drawn, *at, kind.climb_m);
  mark.pixel = at->pixel;
  mark.distance_m = at->distance_m;
  mark.state = at->visible      ? MarkState::seen
               : at->in_picture ? MarkState::hidden
                                : MarkState::outside_picture;
  if (mark.state == MarkState::hidden) mark.in_front = ground.map.to_geo(at->pixel);
  if (mark.state == MarkState::seen)
    mark.on_skyline = !ground.map.to_geo(at->pixel - glm::dvec2(0.0, sky_over_px));
  return mark;
}

}  // namespace

std::string_view name_of(MarkState state) {
  constexpr std::array names{"seen", "hidden behind ground", "outside the picture",
                             "behind the eye", "outside the terrain"};
  return names[static_cast<std::size_t>(state)];
}

std::optional<glm::dvec2> climb(const LocatedGround& ground, glm::dvec2 position, double max_m) {
  const Grid<float>& z = ground.generalized_m;
  const glm::dvec2 start = ground.transform.to_cell(position.x, position.y);
  int x = static_cast<int>(std::lround(start.x));
  int y = static_cast<int>(std::lround(start.y));
  if (!z.contains(x, y)) return std::nullopt;
  while (true) {
    int to_x = x;
    int to_y = y;
    for (int dy = -step_cells; dy <= step_cells; ++dy)
      for (int dx = -step_cells; dx <= step_cells; ++dx)
        if (z.contains(x + dx, y + dy) && z(x + dx, y + dy) > z(to_x, to_y)) {
          to_x = x + dx;
          to_y = y + dy;
        }
    const bool is_top = to_x == x && to_y == y;
    if (is_top) return ground.transform.to_crs(x, y);
    // A slope that continues beyond the search radius is not the summit of this name: the point
    // then stays where its file has it.
    if (glm::length(glm::dvec2(to_x, to_y) - start) * ground.cell_m > max_m) return position;
    x = to_x;
    y = to_y;
  }
}

std::vector<LabelMark> find_marks(const LocatedGround& ground, const std::vector<LabelPoint>& points,
                                  const LabelStyle& style) {
  std::vector<LabelMark> marks(points.size());
  parallel_ranges<std::size_t>(points.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      marks[i] =
          find_mark(ground, points[i], style.kinds[static_cast<std::size_t>(points[i].kind)]);
  });
  return marks;
}

}  // namespace belvedere
