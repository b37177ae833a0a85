#include "renderer/image/rows/row_reducer.h"

#include <algorithm>

#include "base/parallel.h"

namespace belvedere {

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

}  // namespace belvedere
