#include "terrain/generalize/moved_ground.h"

#include <glm/geometric.hpp>

#include "base/filter.h"

namespace belvedere {

glm::dvec2 drawn_cell(const Grid<glm::vec2>& goes_to, glm::dvec2 position) {
  return goes_to.empty() ? position : position + sample_bilinear(goes_to, position.x, position.y);
}

glm::dvec2 origin_cell(const Grid<glm::vec2>& goes_to, glm::dvec2 drawn) {
  if (goes_to.empty()) return drawn;
  // The ground is stretched to at most three times its length, four near lakes, and nowhere
  // compressed to less than a third. A fixed-point iteration with this step therefore converges.
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
