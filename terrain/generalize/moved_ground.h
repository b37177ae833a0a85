#pragma once

#include <glm/vec2.hpp>

#include "base/grid.h"

namespace belvedere {

// Ground that widened valleys moved, both ways. `came_from` as WidenedValleys has it, cells from each cell to where its ground was; empty:
// nothing moved. Columns and rows, cell centres at whole numbers; beyond the grid its edge goes on.

// The cell whose ground is drawn at a cell.
glm::dvec2 origin_cell(const Grid<glm::vec2>& came_from, glm::dvec2 drawn);
// The cell at which ground of a cell is drawn: origin_cell() of it is `origin`, to a hundredth of a cell, wherever ground moved away from
// the water. Water and its banks stay.
glm::dvec2 drawn_cell(const Grid<glm::vec2>& came_from, glm::dvec2 origin);

}  // namespace belvedere
