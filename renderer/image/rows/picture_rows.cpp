#include "renderer/image/rows/picture_rows.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "base/error.h"

namespace belvedere {

PictureRows::PictureRows(std::string path, int width, int height, int band_rows)
    : path_(std::move(path)), width_(width), height_(height), band_rows_(band_rows) {
  if (width < 1 || height < 1) throw Error(ErrorKind::bug, path_, "a picture without pixels");
}

void PictureRows::write_rows(const Grid<glm::vec3>& rows) {
  if (rows.empty()) return;
  if (finished_ || rows.width() != width_ || rows.height() > height_ - next_row_)
    throw Error(ErrorKind::bug, path_,
                fmt::format("{} × {} pixels after row {}", rows.width(), rows.height(), next_row_),
                fmt::format("{} × {} in all", width_, height_));
  for (int y = 0; y < rows.height();) {
    const int at = next_row_ % band_rows_;
    const int count = std::min(rows.height() - y, band_rows_ - at);
    take(rows, y, count, at);
    y += count;
    next_row_ += count;
    if (at + count == band_rows_ || next_row_ == height_)
      write_band(next_row_ - at - count, at + count);
  }
}

void PictureRows::finish() {
  if (finished_ || next_row_ != height_)
    throw Error(ErrorKind::bug, path_, fmt::format("ends at row {} of {}", next_row_, height_));
  complete();
  finished_ = true;
}

void PictureRows::commit() {
  if (!finished_) throw Error(ErrorKind::bug, path_, "is not finished");
  replace();
}

void write_whole(PictureRows& file, const Grid<glm::vec3>& picture) {
  file.write_rows(picture);
  file.finish();
  file.commit();
}

}  // namespace belvedere
