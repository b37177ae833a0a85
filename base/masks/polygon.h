#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

namespace belvedere {

// Whether a position lies in the area bounded by closed rings, by the even–odd rule: a ring within
// a ring is a hole. The last point of a ring is joined to its first. A position on an edge belongs
// to one of the adjacent areas.
inline bool encloses(const std::vector<std::vector<glm::dvec2>>& rings, glm::dvec2 position) {
  bool inside = false;
  for (const std::vector<glm::dvec2>& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const glm::dvec2 a = ring[i];
      const glm::dvec2 b = ring[(i + 1) % ring.size()];
      if ((a.y <= position.y) != (b.y <= position.y) &&
          position.x < a.x + (position.y - a.y) * ((b.x - a.x) / (b.y - a.y)))
        inside = !inside;
    }
  return inside;
}

// The signed area of a ring, positive if it runs counterclockwise (y up).
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
