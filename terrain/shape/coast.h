#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace belvedere {

// The sea bounded by coastlines.
struct CoastAreas {
  // Outlines and islands: what an odd number of them encloses is sea. Without the closing point.
  std::vector<std::vector<glm::dvec2>> rings;
  std::string problem;  // why the lines are invalid, as a message; then there are no rings
};

// Closes coastlines, which have the land to their left, along the edges of the terrain `low` …
// `high`. Pieces that end where another begins are one line; counterclockwise rings are islands. If
// no line crosses the edges, the orientation of the largest ring decides what surrounds all. It is
// a problem if a line begins or ends on the terrain, or two adjacent ones run in the same
// direction.
CoastAreas close_coast(const std::vector<std::vector<glm::dvec2>>& lines, glm::dvec2 low,
                       glm::dvec2 high);

}  // namespace belvedere
