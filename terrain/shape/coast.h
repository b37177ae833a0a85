#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace belvedere {

// The sea that coast lines bound.
struct CoastAreas {
  // Outlines and islands: what an odd number of them encloses is sea. Without the closing place.
  std::vector<std::vector<glm::dvec2>> rings;
  std::string problem;  // why the lines bound nothing, in words; then there are no rings
};

// Closes coast lines, which have the land to their left, along the edges of the terrain `low` … `high`. Pieces that end where another
// begins are one line; rings that run against the clock are islands. Where no line crosses the edges the largest ring says what lies around
// all. A line that begins or ends on the terrain, or two side by side that run the same way, bound nothing.
CoastAreas close_coast(const std::vector<std::vector<glm::dvec2>>& lines, glm::dvec2 low, glm::dvec2 high);

}  // namespace belvedere
