#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

namespace belvedere {

// Whether a place lies in the area that closed rings bound, by the even–odd rule: a ring within a ring is a hole. The last place of a ring
// is joined to its first; what lies on an edge is in one of the areas beside it.
inline bool encloses(const std::vector<std::vector<glm::dvec2>>& rings, glm::dvec2 place) {
  bool inside = false;
  for (const std::vector<glm::dvec2>& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec2 a = ring[i];
      const glm::dvec2 b = ring[(i + 1) % ring.size()];
      if ((a.y <= place.y) != (b.y <= place.y) && place.x < a.x + (place.y - a.y) * ((b.x - a.x) / (b.y - a.y))) inside = !inside;
    }
  return inside;
}

// The area of a ring, above 0 where it runs against the clock (y up).
inline double signed_area(const std::vector<glm::dvec2>& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 a = ring[i] - ring[0];
    const glm::dvec2 b = ring[(i + 1) % ring.size()] - ring[0];
    sum += 0.5 * (a.x * b.y - b.x * a.y);
  }
  return sum;
}

}  // namespace belvedere
