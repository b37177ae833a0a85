#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/grid.h"

namespace belvedere::tools {

// A picture of a table and its caption; an empty picture leaves its cell empty.
struct TableCell {
  Grid<glm::vec3> picture;  // encoded sRGB
  std::string caption;
};
struct PictureTable {
  std::vector<std::string> columns;           // above them; all empty: no headings
  std::vector<std::string> rows;              // left of them; empty: no row names
  std::vector<std::vector<TableCell>> cells;  // [row][column]
  Grid<glm::vec3> foot;                       // below them all, such as a legend; empty: none
};

// The pictures side by side and below each other, pixel by pixel, with their names. Columns are as
// wide and rows as high as the largest picture in them.
Grid<glm::vec3> draw_table(const PictureTable& table);

}  // namespace belvedere::tools
