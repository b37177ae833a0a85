#include "terrain/generalize/moved_ground.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace belvedere {
namespace {

glm::dvec2 shift_at(const Grid<glm::vec2>& came_from, glm::dvec2 cell) {
  const glm::dvec2 corner = glm::floor(cell);
  const glm::dvec2 part = cell - corner;
  const auto x = static_cast<int>(corner.x);
  const auto y = static_cast<int>(corner.y);
  const glm::dvec2 upper = glm::mix(glm::dvec2(came_from.clamped(x, y)), glm::dvec2(came_from.clamped(x + 1, y)), part.x);
  const glm::dvec2 lower = glm::mix(glm::dvec2(came_from.clamped(x, y + 1)), glm::dvec2(came_from.clamped(x + 1, y + 1)), part.x);
  return glm::mix(upper, lower, part.y);
}

}  // namespace

glm::dvec2 origin_cell(const Grid<glm::vec2>& came_from, glm::dvec2 drawn) {
  return came_from.empty() ? drawn : drawn + shift_at(came_from, drawn);
}

glm::dvec2 drawn_cell(const Grid<glm::vec2>& came_from, glm::dvec2 origin) {
  if (came_from.empty()) return origin;
  const double here = glm::length(shift_at(came_from, origin));
  if (here <= 0.0) return origin;
  // All of a new floor came from the bank: close to it the way out cannot be told from the moves there. So first outwards, until the ground
  // of a place comes from farther in than that, …
  const glm::dvec2 outwards = -shift_at(came_from, origin) / here;
  constexpr int doublings = 16;
  double way = here;
  for (int i = 0; i < doublings && glm::length(shift_at(came_from, origin + way * outwards)) > way; ++i) way *= 2.0;
  // … then back: walls move by at most a third of a cell less from one cell to the next, so each step leaves a third of the way.
  constexpr int steps = 40;
  constexpr double exact_cells = 1e-4;
  glm::dvec2 at = origin + way * outwards;
  for (int i = 0; i < steps; ++i) {
    const glm::dvec2 next = origin - shift_at(came_from, at);
    const bool found = glm::length(next - at) < exact_cells;
    at = next;
    if (found) break;
  }
  return at;
}

}  // namespace belvedere
