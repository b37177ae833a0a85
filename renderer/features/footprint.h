#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace belvedere {

// A rectangle on the map: its middle, half of its longer side and half of its shorter one as vectors.
struct Footprint {
  glm::dvec2 middle{0.0};
  glm::dvec2 along{0.0};
  glm::dvec2 across{0.0};
};

// A quarter turn to the left.
inline glm::dvec2 perpendicular(glm::dvec2 v) { return {-v.y, v.x}; }

// The rectangle around an outline that has the least area.
Footprint footprint_of(const std::vector<glm::dvec2>& outline);

// The wings of a house: rectangles that cover its outline without its courts, the first the largest. They lie as the rectangle around the
// whole does, and reach into each other where they meet, so that ridge meets ridge. One for what is nearly a rectangle, or what no few
// rectangles cover: that around the whole.
std::vector<Footprint> wings_of(const std::vector<std::vector<glm::dvec2>>& rings);

}  // namespace belvedere
