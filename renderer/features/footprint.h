#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace belvedere {

// A rectangle on the map: its centre, and half of its longer and shorter sides as vectors.
struct Footprint {
  glm::dvec2 centre{0.0};
  glm::dvec2 along{0.0};
  glm::dvec2 across{0.0};
};

// A quarter turn to the left.
inline glm::dvec2 perpendicular(glm::dvec2 v) { return {-v.y, v.x}; }

// The rectangle of minimum area around an outline.
Footprint footprint_of(const std::vector<glm::dvec2>& outline);

// The wings of a house: rectangles that cover its outline without its courts, the largest first.
// They have the orientation of the rectangle around the whole, and overlap where they meet, so that
// ridges meet. One for a nearly rectangular house or one that a few rectangles cannot cover: the
// rectangle around the whole.
std::vector<Footprint> wings_of(const std::vector<std::vector<glm::dvec2>>& rings);

}  // namespace belvedere
