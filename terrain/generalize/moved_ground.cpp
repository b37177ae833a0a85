#include "terrain/generalize/moved_ground.h"

#include <glm/geometric.hpp>

#include "base/filter.h"

namespace belvedere {

glm::dvec2 drawn_cell(const Grid<glm::vec2>& goes_to, glm::dvec2 place) {
  return goes_to.empty() ? place : place + sample_bilinear(goes_to, place.x, place.y);
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
