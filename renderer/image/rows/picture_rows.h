#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// A picture file that is written from top to bottom, any number of rows at a time; the split into
// rows changes no byte of it. The writer keeps at most the band that its format packs at once. The
// rows go to a temporary name (output_file.h): without commit() an older file is unchanged and the
// temporary one is removed. Throws Error(output), and Error(bug) for rows that do not fit.
class PictureRows {
 public:
  virtual ~PictureRows() = default;
  PictureRows(const PictureRows&) = delete;
  PictureRows& operator=(const PictureRows&) = delete;

  // Colours in the form of the format: encoded 0…1, or scene-linear.
  void write_rows(const Grid<glm::vec3>& rows);
  // Completes the file, flushes it to disk and compares what is read back with what was written, by
  // a hash.
  void finish();
  // Replaces the older one; call finish() before.
  void commit();

  int width() const { return width_; }
  int height() const { return height_; }

 protected:
  PictureRows(std::string path, int width, int height, int band_rows);

 private:
  // Rows [first, first + rows) of `from`, which are next in the band, from its row `at` on.
  virtual void take(const Grid<glm::vec3>& from, int first, int rows, int at) = 0;
  // The band that begins at row y0 of the picture is full, or the picture ends with it.
  virtual void write_band(int y0, int rows) = 0;
  virtual void complete() = 0;
  virtual void replace() = 0;

  std::string path_;
  int width_;
  int height_;
  int band_rows_;
  int next_row_ = 0;
  bool finished_ = false;
};

// All rows at once, finish(), commit().
void write_whole(PictureRows& file, const Grid<glm::vec3>& picture);

// Reduces a picture by a whole factor while its rows arrive: each pixel is the mean of factor ×
// factor, at the right and lower border of the available ones. Sums are in double, row by row, so
// that the split into rows changes no bit.
class RowReducer {
 public:
  // factor ≥ 1
  RowReducer(int width, int height, int factor);
  // The reduced rows that are complete with these: often none, which is an empty picture.
  Image reduce(const Image& rows);

  int width() const { return (width_ + factor_ - 1) / factor_; }
  int height() const { return (height_ + factor_ - 1) / factor_; }

 private:
  int width_;
  int height_;
  int factor_;
  int next_row_ = 0;
  std::vector<glm::dvec3> sums_;  // of the current row
};

// A picture (encoded sRGB) reduced to a size no larger than its own, in OKLab: the colour of the
// mean of the pixels that each result pixel touches.
Grid<glm::vec3> reduced_oklab(const Grid<glm::vec3>& picture, glm::ivec2 size);

}  // namespace belvedere
