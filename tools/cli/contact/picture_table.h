#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/grid.h"

namespace belvedere::tools {

// A picture of a table and what stands below it; an empty picture leaves its place empty.
struct TableCell {
  Grid<glm::vec3> picture;  // encoded sRGB
  std::string caption;
};
struct PictureTable {
  std::vector<std::string> columns;           // above them; all empty: nothing stands there
  std::vector<std::string> rows;              // left of them; empty: nothing stands there
  std::vector<std::vector<TableCell>> cells;  // [row][column]
  Grid<glm::vec3> foot;                       // below them all, such as a legend; empty: none
};

// The pictures beside and below each other, pixel by pixel, with their names. Columns are as wide and rows as high as the largest of them.
Grid<glm::vec3> draw_table(const PictureTable& table);

}  // namespace belvedere::tools
