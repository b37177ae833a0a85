#include "terrain/generalize/moved_ground.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace belvedere {
namespace {

glm::dvec2 move_at(const Grid<glm::vec2>& goes_to, glm::dvec2 cell) {
  // Places may lie anywhere: beyond the grid its edge goes on, and an int holds no more.
  const glm::dvec2 inside = glm::clamp(cell, glm::dvec2(0.0), glm::dvec2(goes_to.width() - 1.0, goes_to.height() - 1.0));
  const glm::dvec2 corner = glm::floor(inside);
  const glm::dvec2 part = inside - corner;
  const auto x = static_cast<int>(corner.x);
  const auto y = static_cast<int>(corner.y);
  const glm::dvec2 upper = glm::mix(glm::dvec2(goes_to.clamped(x, y)), glm::dvec2(goes_to.clamped(x + 1, y)), part.x);
  const glm::dvec2 lower = glm::mix(glm::dvec2(goes_to.clamped(x, y + 1)), glm::dvec2(goes_to.clamped(x + 1, y + 1)), part.x);
  return glm::mix(upper, lower, part.y);
}

}  // namespace

glm::dvec2 drawn_cell(const Grid<glm::vec2>& goes_to, glm::dvec2 place) {
  return goes_to.empty() ? place : place + move_at(goes_to, place);
}

glm::dvec2 origin_cell(const Grid<glm::vec2>& goes_to, glm::dvec2 drawn) {
  if (goes_to.empty()) return drawn;
  // Ground is drawn out to three times its length at most, four near lakes, and nowhere drawn together to less than a third: steps of so
  // much of what is missing come nearer each time.
  constexpr double part_of_step = 0.4;
  constexpr int steps = 60;
  constexpr double exact_cells = 1e-4;
  glm::dvec2 at = drawn;
  for (int i = 0; i < steps; ++i) {
    const glm::dvec2 missing = drawn - drawn_cell(goes_to, at);
    if (glm::length(missing) < exact_cells) break;
    at += part_of_step * missing;
  }
  return at;
}

}  // namespace belvedere
