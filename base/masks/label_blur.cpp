#include "base/masks/label_blur.h"

#include "base/filter.h"

namespace belvedere {
namespace {

struct Box {
  int x0, y0, x1 = -1, y1 = -1;  // inclusive; x1 < x0: no texel
};

std::vector<Box> boxes_of(const Grid<std::uint8_t>& labels) {
  std::vector<Box> boxes(256, Box{labels.width(), labels.height()});
  for (int y = 0; y < labels.height(); ++y)
    for (int x = 0; x < labels.width(); ++x) {
      Box& box = boxes[labels(x, y)];
      box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x), std::max(box.y1, y)};
    }
  return boxes;
}

}  // namespace

Grid<float> blur_within_labels(const Grid<float>& values, const Grid<std::uint8_t>& labels,
                               double sigma) {
  const std::vector<Box> boxes = boxes_of(labels);
  Grid<float> out(values.width(), values.height(), 0.F);
  for (std::size_t label = 0; label < no_label; ++label) {
    const Box& box = boxes[label];
    if (box.x1 < box.x0) continue;
    // The blur repeats the values at the border of its grid: a border of one empty cell around the
    // box makes them 0, as they are beyond the box.
    const int width = box.x1 - box.x0 + 3;
    const int height = box.y1 - box.y0 + 3;
    Grid<float> sum(width, height, 0.F);
    Grid<float> weight(width, height, 0.F);
    for (int y = box.y0; y <= box.y1; ++y)
      for (int x = box.x0; x <= box.x1; ++x)
        if (labels(x, y) == label) {
          sum(x - box.x0 + 1, y - box.y0 + 1) = values(x, y);
          weight(x - box.x0 + 1, y - box.y0 + 1) = 1.F;
        }
    sum = gaussian_blur(sum, sigma);
    weight = gaussian_blur(weight, sigma);
    for (int y = box.y0; y <= box.y1; ++y)
      for (int x = box.x0; x <= box.x1; ++x)
        if (labels(x, y) == label) {
          const std::size_t i = sum.index(x - box.x0 + 1, y - box.y0 + 1);
          out(x, y) = weight[i] > 1e-6F ? sum[i] / weight[i] : values(x, y);
        }
  }
  return out;
}

}  // namespace belvedere
