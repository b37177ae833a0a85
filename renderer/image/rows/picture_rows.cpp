#include "renderer/image/rows/picture_rows.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "renderer/image/srgb.h"

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

RowReducer::RowReducer(int width, int height, int factor)
    : width_(width),
      height_(height),
      factor_(factor),
      sums_(static_cast<std::size_t>((width + factor - 1) / factor), glm::dvec3(0.0)) {}

Image RowReducer::reduce(const Image& rows) {
  const int end = next_row_ + rows.height();
  const int done = end == height_ ? height() : end / factor_;  // rows of the small picture
  const int first = next_row_ / factor_;
  if (rows.empty()) return {};
  Image out = done > first ? Image(width(), done - first) : Image();
  constexpr int grain = 256;  // columns
  parallel_ranges(width(), grain, [&](int begin, int stop) {
    for (int y = 0; y < rows.height(); ++y) {
      const int position = next_row_ + y;
      const glm::vec3* from = rows.row(y);
      for (int x = begin; x < stop; ++x)
        for (int i = x * factor_; i < std::min(width_, (x + 1) * factor_); ++i)
          sums_[static_cast<std::size_t>(x)] += glm::dvec3(from[i]);
      if ((position + 1) % factor_ != 0 && position + 1 != height_) continue;
      const int high = position % factor_ + 1;
      for (int x = begin; x < stop; ++x) {
        const int wide = std::min(width_, (x + 1) * factor_) - x * factor_;
        out(x, position / factor_ - first) =
            glm::vec3(sums_[static_cast<std::size_t>(x)] / (static_cast<double>(wide) * high));
        sums_[static_cast<std::size_t>(x)] = glm::dvec3(0.0);
      }
    }
  });
  next_row_ = end;
  return out;
}

Grid<glm::vec3> reduced_oklab(const Grid<glm::vec3>& picture, glm::ivec2 size) {
  const auto range = [](int i, int count, int whole) {
    const std::int64_t from = std::int64_t{i} * whole / count;
    const std::int64_t to = (std::int64_t{i + 1} * whole + count - 1) / count;
    return std::pair(static_cast<int>(from), static_cast<int>(to));
  };
  Grid<glm::vec3> out(size.x, size.y);
  parallel_rows(size.y, [&](int y) {
    const auto [top, bottom] = range(y, size.y, picture.height());
    for (int x = 0; x < size.x; ++x) {
      const auto [left, right] = range(x, size.x, picture.width());
      glm::dvec3 sum(0.0);
      for (int v = top; v < bottom; ++v)
        for (int u = left; u < right; ++u) sum += glm::dvec3(picture(u, v));
      out(x, y) = glm::vec3(
          to_oklab(glm::vec3(sum / static_cast<double>((bottom - top) * (right - left)))));
    }
  });
  return out;
}

}  // namespace belvedere
