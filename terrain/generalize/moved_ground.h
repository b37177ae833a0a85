#pragma once

#include <glm/vec2.hpp>

#include "base/grid.h"

namespace belvedere {

// The displacement of features by widened valleys, in both directions. `goes_to` as in
// WidenedValleys, cells from each cell of the map to where it is drawn; empty: nothing moved.
// Columns and rows, cell centres at whole numbers; extended beyond the grid by its border.

// The drawn cell of a cell of the map.
glm::dvec2 drawn_cell(const Grid<glm::vec2>& goes_to, glm::dvec2 position);
// The cell of the map that is drawn at `drawn`; inverse of drawn_cell() to a hundredth of a cell.
glm::dvec2 origin_cell(const Grid<glm::vec2>& goes_to, glm::dvec2 drawn);

}  // namespace belvedere
