#include "tools/cli/contact/picture_table.h"

#include <algorithm>

#include "tools/report/bitmap_text.h"

namespace belvedere::tools {
namespace {

constexpr int gap = 12;
constexpr int text_scale = 2;
constexpr int line_px = text_height * text_scale + 6;
const glm::vec3 paper(1.F);
const glm::vec3 ink(0.1F);

// Where each begins, and at last where all end.
std::vector<int> begins(int first, const std::vector<int>& sizes) {
  std::vector<int> at = {first};
  for (const int size : sizes) at.push_back(at.back() + size + gap);
  return at;
}

}  // namespace

Grid<glm::vec3> draw_table(const PictureTable& table) {
  std::vector<int> widths;
  for (const std::string& name : table.columns) widths.push_back(text_width(name, text_scale));
  std::vector<int> heights(table.cells.size(), 0);
  for (std::size_t r = 0; r < table.cells.size(); ++r)
    for (std::size_t c = 0; c < table.cells[r].size(); ++c) {
      const TableCell& cell = table.cells[r][c];
      widths[c] = std::max({widths[c], cell.picture.width(), text_width(cell.caption, text_scale)});
      heights[r] = std::max(heights[r], cell.picture.height() + (cell.caption.empty() ? 0 : line_px));
    }
  int left = gap;
  for (const std::string& name : table.rows) left = std::max(left, 2 * gap + text_width(name, text_scale));
  const std::vector<int> x = begins(left, widths);
  const std::vector<int> y = begins(gap + line_px, heights);
  const int foot_px = table.foot.empty() ? 0 : table.foot.height() + gap;
  Grid<glm::vec3> sheet(std::max(x.back(), left + table.foot.width() + gap), y.back() + foot_px, paper);
  for (int j = 0; j < table.foot.height(); ++j) std::copy_n(table.foot.row(j), table.foot.width(), sheet.row(y.back() + j) + left);
  for (std::size_t c = 0; c < table.columns.size(); ++c) draw_text(sheet, x[c], gap, table.columns[c], ink, text_scale);
  for (std::size_t r = 0; r < table.rows.size(); ++r) draw_text(sheet, gap, y[r], table.rows[r], ink, text_scale);
  for (std::size_t r = 0; r < table.cells.size(); ++r)
    for (std::size_t c = 0; c < table.cells[r].size(); ++c) {
      const TableCell& cell = table.cells[r][c];
      for (int j = 0; j < cell.picture.height(); ++j) std::copy_n(cell.picture.row(j), cell.picture.width(), sheet.row(y[r] + j) + x[c]);
      draw_text(sheet, x[c], y[r] + cell.picture.height() + 4, cell.caption, ink, text_scale);
    }
  return sheet;
}

}  // namespace belvedere::tools
