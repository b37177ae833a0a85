#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/grid.h"
#include "base/text/json.h"

namespace belvedere::tools {

struct ReportColumn {
  ReportColumn(std::string key_, std::string title_, std::string format_ = {},
               std::string meaning_ = {})
      : key(std::move(key_)),
        title(std::move(title_)),
        format(std::move(format_)),
        meaning(std::move(meaning_)) {}

  std::string key;      // of its cells, in report.json
  std::string title;    // at its head
  std::string format;   // number format of the page: "" unchanged, ".3f", "+.1f", ".3g" as in C++,
                        // ".0%" as a share; "hidden"
  std::string meaning;  // tooltip of the heading
};

// A number with all its digits; null where it is not finite: not known.
Json known(double value);
// Cells that are more than a text or a number: a figure and whether it is good, a name that links
// to a file, a colour, a range.
Json evaluated(double value, bool good);
Json linked(const std::string& text, const std::string& file);
Json swatch(glm::vec3 rgb);
Json range(double min, double max);

class ReportTable {
 public:
  explicit ReportTable(std::vector<ReportColumn> columns);

  // A number, text or Json for each column.
  template <class... Cells>
  ReportTable& row(const Cells&... cells) {
    return add_row({cell(cells)...});
  }
  ReportTable& add_row(std::vector<Json> cells);
  bool empty() const { return rows_.empty(); }
  const Json& rows() const { return rows_; }
  Json json(const std::string& title) const;

 private:
  template <class Cell>
  static Json cell(const Cell& value) {
    if constexpr (std::is_arithmetic_v<Cell>)
      return known(static_cast<double>(value));
    else if constexpr (std::is_same_v<Cell, Json>)
      return value;
    else
      return Json::text(value);
  }

  std::vector<ReportColumn> columns_;
  Json rows_ = Json::array();
};

// The head of a report, above its sections. Plain text, like all texts of reports.
struct ReportHead {
  std::string title;
  std::string lead;            // its first sentence
  std::string command;         // command that makes it; may be empty
  Json data = Json::object();  // only in JSON
};

// The results of a command in one form for all: sections, with what is added after each one's
// begin. The page, tools/report/page/, draws it and alone handles markup and rounding; report.json
// holds the same for programs.
class Report {
 public:
  enum class Pictures {
    beside,
    inside
  };  // files in the folder, or embedded in the page, for which the folder is only scratch

  // Creates the folder; Error(output) where it cannot.
  explicit Report(std::string folder, Pictures pictures = Pictures::beside);

  // State: "good" or "bad" colours its title.
  void section(const std::string& id, const std::string& title, const std::string& text = {},
               const std::string& state = {});
  void text(const std::string& text);
  void list(const std::vector<std::string>& texts);
  void listing(const std::string& text);  // preformatted
  void table(const ReportTable& table, const std::string& title = {});
  // An element that the page has a function for: "bars", "coverage" ….
  void add(std::string_view kind, Json part);

  // Only the file NAME.png.
  void write_picture(const std::string& name, const Grid<glm::vec3>& pixels) const;
  // Pictures stand side by side until next_row or another element.
  void picture(const std::string& name, const Grid<glm::vec3>& pixels, const std::string& caption);
  void next_row();
  // On top of each other, with a slider between them.
  void compare(const std::string& left, const Grid<glm::vec3>& left_pixels,
               const std::string& right, const Grid<glm::vec3>& right_pixels);

  // The page alone, or it and report.json, as index.html, in the folder.
  std::string page(const ReportHead& head);
  void write(const ReportHead& head);

 private:
  Json picture_json(const std::string& name, const Grid<glm::vec3>& pixels,
                    const std::string& caption) const;
  std::string finish(const ReportHead& head);
  void end_section();

  std::string folder_;
  Pictures pictures_;
  Json sections_ = Json::array();
  Json section_ = Json::object();
  Json parts_ = Json::array();
  Json row_ = Json::array();
};

}  // namespace belvedere::tools
