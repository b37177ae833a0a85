#include "tools/cli/contact/scene_sweep.h"

#include <algorithm>
#include <fmt/core.h>

#include "base/error.h"
#include "tools/options/options.h"
#include "tools/report/report_pictures.h"

namespace belvedere::tools {
namespace {

std::vector<std::string> split_values(const std::string& text) {
  std::vector<std::string> values(1);
  int depth = 0;
  char quote = 0;
  for (const char letter : text) {
    if (quote != 0) {
      if (letter == quote) quote = 0;
    } else if (letter == '"' || letter == '\'') {
      quote = letter;
    } else if (letter == '[' || letter == '{') {
      ++depth;
    } else if (letter == ']' || letter == '}') {
      --depth;
    } else if (letter == ',' && depth == 0) {
      values.emplace_back();
      continue;
    }
    values.back() += letter;
  }
  return values;
}

}  // namespace

SceneSweep split_sweep(const std::vector<std::string>& settings) {
  SceneSweep sweep;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    const std::vector<std::string> values = equals == std::string::npos
                                                ? std::vector<std::string>()
                                                : split_values(setting.substr(equals + 1));
    if (values.size() < 2) {
      sweep.settings.push_back(setting);  // invalid ones are refused with the scene
      continue;
    }
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (values[i].empty())
        refuse("--set", fmt::format("{} with an empty value", setting), "KEY=VALUE,VALUE,…");
      if (std::count(values.begin(), values.end(), values[i]) > 1)
        refuse("--set", fmt::format("{} with {} twice", setting, values[i]), "each value once");
    }
    sweep.axes.push_back({setting.substr(0, equals), values});
  }
  if (sweep.axes.empty())
    refuse("--set", "no key with several values", "--set KEY=VALUE,VALUE,… of one key or two");
  if (sweep.axes.size() > 2)
    refuse("--set", fmt::format("{} keys with several values", sweep.axes.size()),
           "one or two: columns and rows of a sheet");
  return sweep;
}

namespace {

constexpr int table_gap = 12;
const glm::vec3 table_paper(1.F);
const glm::vec3 table_ink(0.1F);

// Start of each, and at the end the total.
std::vector<int> begins(int first, const std::vector<int>& sizes) {
  std::vector<int> at = {first};
  for (const int size : sizes) at.push_back(at.back() + size + table_gap);
  return at;
}

// Breaks a caption into lines no wider than its picture, so that the caption does not widen a small
// picture's column; a wider word has its own line.
std::vector<std::string> caption_lines(const TableCell& cell) {
  std::vector<std::string> lines;
  std::size_t at = 0;
  while (at < cell.caption.size()) {
    const std::size_t space = cell.caption.find(' ', at);
    const std::size_t end = space == std::string::npos ? cell.caption.size() : space;
    const std::string word = cell.caption.substr(at, end - at);
    at = end + 1;
    const bool fits = !lines.empty() &&
                      (cell.picture.empty() || text_width(lines.back() + " " + word,
                                                          caption_scale) <= cell.picture.width());
    if (fits)
      lines.back() += " " + word;
    else
      lines.push_back(word);
  }
  return lines;
}

}  // namespace

Grid<glm::vec3> draw_table(const PictureTable& table) {
  std::vector<int> widths;
  for (const std::string& name : table.columns) widths.push_back(text_width(name, caption_scale));
  std::vector<int> heights(table.cells.size(), 0);
  for (std::size_t r = 0; r < table.cells.size(); ++r)
    for (std::size_t c = 0; c < table.cells[r].size(); ++c) {
      const TableCell& cell = table.cells[r][c];
      const std::vector<std::string> lines = caption_lines(cell);
      widths[c] = std::max(widths[c], cell.picture.width());
      for (const std::string& line : lines)
        widths[c] = std::max(widths[c], text_width(line, caption_scale));
      heights[r] = std::max(
          heights[r], cell.picture.height() + caption_line_px * static_cast<int>(lines.size()));
    }
  int left = table_gap;
  for (const std::string& name : table.rows)
    left = std::max(left, 2 * table_gap + text_width(name, caption_scale));
  const std::vector<int> x = begins(left, widths);
  const bool named = std::any_of(table.columns.begin(), table.columns.end(),
                                 [](const std::string& name) { return !name.empty(); });
  const std::vector<int> y = begins(table_gap + (named ? caption_line_px : 0), heights);
  const int foot_px = table.foot.empty() ? 0 : table.foot.height() + table_gap;
  Grid<glm::vec3> sheet(std::max(x.back(), left + table.foot.width() + table_gap),
                        y.back() + foot_px, table_paper);
  for (int j = 0; j < table.foot.height(); ++j)
    std::copy_n(table.foot.row(j), table.foot.width(), sheet.row(y.back() + j) + left);
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    draw_text(sheet, x[c], table_gap, table.columns[c], table_ink, caption_scale);
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    draw_text(sheet, table_gap, y[r], table.rows[r], table_ink, caption_scale);
  for (std::size_t r = 0; r < table.cells.size(); ++r)
    for (std::size_t c = 0; c < table.cells[r].size(); ++c) {
      const TableCell& cell = table.cells[r][c];
      for (int j = 0; j < cell.picture.height(); ++j)
        std::copy_n(cell.picture.row(j), cell.picture.width(), sheet.row(y[r] + j) + x[c]);
      int text_y = y[r] + cell.picture.height() + 4;
      for (const std::string& line : caption_lines(cell)) {
        draw_text(sheet, x[c], text_y, line, table_ink, caption_scale);
        text_y += caption_line_px;
      }
    }
  return sheet;
}

}  // namespace belvedere::tools
