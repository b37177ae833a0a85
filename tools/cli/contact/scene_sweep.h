#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/grid.h"
#include "base/progress.h"

namespace belvedere::tools {

// A key of a scene with the values to try, as typed.
struct SceneAxis {
  std::string key;
  std::vector<std::string> values;
};
// The content of the --set options: keys with one value, and one or two with several.
struct SceneSweep {
  std::vector<std::string> settings;  // KEY=VALUE
  std::vector<SceneAxis> axes;        // along the columns, down the rows
};

// Values are separated by commas outside brackets and quotes: "light.azimuth_deg=300,320",
// "generalize.foreground=[1,1],[1,0]". Error(usage) where no key has several values, more than two
// have, or a value occurs twice or is empty.
SceneSweep split_sweep(const std::vector<std::string>& settings);

// Stages of a sweep name the result they belong to; notes, the same for all, are printed once.
class SweepProgress : public Progress {
 public:
  SweepProgress(Progress& whole, std::size_t result, std::size_t results)
      : whole_(whole), result_(result), results_(results) {}
  void begin(std::string_view stage, double total) override {
    whole_.begin(
        std::to_string(result_) + " of " + std::to_string(results_) + ": " + std::string(stage),
        total);
  }
  void advance(double amount) override { whole_.advance(amount); }
  void note(std::string_view text) override {
    if (result_ == 1) whole_.note(text);
  }

 private:
  Progress& whole_;
  std::size_t result_;
  std::size_t results_;
};

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
