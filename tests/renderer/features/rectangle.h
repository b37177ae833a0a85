#pragma once

#include <cmath>
#include <glm/vec2.hpp>
#include <vector>

namespace belvedere::test {

// Corners of a rectangle whose length is rotated by `turn` (radians) from the x axis.
inline std::vector<glm::dvec2> rectangle(glm::dvec2 centre, double length, double width,
                                         double turn) {
  const glm::dvec2 u{std::cos(turn), std::sin(turn)};
  const glm::dvec2 v{-u.y, u.x};
  std::vector<glm::dvec2> out;
  for (const glm::dvec2 corner :
       {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(1, 1), glm::dvec2(-1, 1)})
    out.push_back(centre + 0.5 * length * corner.x * u + 0.5 * width * corner.y * v);
  return out;
}

}  // namespace belvedere::test
