#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/grid.h"
#include "base/pixel_rect.h"

namespace belvedere::tools {

// A row of a table; tag "td" or "th". Cells are HTML.
std::string html_row(const std::vector<std::string>& cells, const char* tag = "td");

// A folder with a page and its pictures: writes the files and gathers the page's text.
class ReportFolder {
 public:
  // Makes the folder; Error(output) where it cannot.
  explicit ReportFolder(std::string folder);

  void add(const std::string& html);
  // A row of pictures under a heading, with a sentence on how to read them.
  void begin_figure(const std::string& id, const std::string& heading, const std::string& how_to_read);
  void next_row();
  // Only the file NAME.png.
  void write_picture(const std::string& name, const Grid<glm::vec3>& pixels) const;
  void picture(const std::string& name, const Grid<glm::vec3>& pixels, const std::string& caption);
  void end_figure();

  void write(const std::string& name, const std::string& text) const;
  // index.html: what was added, under a heading, a first sentence and the command that makes it. Plain text, not HTML.
  void write_page(const std::string& title, const std::string& heading, const std::string& lead, const std::string& command) const;
  const std::string& body() const { return body_; }

 private:
  std::string folder_;
  std::string body_;
};

// Adds relief pictures of terrains of one cell size.
class ReliefPainter {
 public:
  static constexpr int whole_px = 600;   // longest side of a picture of the whole terrain
  static constexpr int window_px = 420;  // of a window cell by cell, where fine detail can be seen

  ReliefPainter(ReportFolder& folder, glm::dvec2 cell_m) : folder_(folder), cell_m_(cell_m) {}
  void whole(const std::string& name, const Grid<float>& altitude_m, const std::string& caption);
  void window(const std::string& name, const Grid<float>& altitude_m, const PixelRect& where, const std::string& caption);

 private:
  ReportFolder& folder_;
  glm::dvec2 cell_m_;
};

}  // namespace belvedere::tools
