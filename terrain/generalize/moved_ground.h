#pragma once

#include <glm/vec2.hpp>

#include "base/grid.h"

namespace belvedere {

// What lies on ground that widened valleys moved, both ways. `goes_to` as WidenedValleys has it, cells from each cell of the map to where
// it is drawn; empty: nothing moved. Columns and rows, cell centres at whole numbers; beyond the grid its edge goes on.

// The cell at which what lies on a cell is drawn.
glm::dvec2 drawn_cell(const Grid<glm::vec2>& goes_to, glm::dvec2 place);
// The cell of what is drawn at a cell: drawn_cell() of it is `drawn`, to a hundredth of a cell.
glm::dvec2 origin_cell(const Grid<glm::vec2>& goes_to, glm::dvec2 drawn);

}  // namespace belvedere
