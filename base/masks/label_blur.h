#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// Value of mask pixels without a label.
inline constexpr std::uint8_t no_label = 255;

// Gaussian blur of `values` within each label: a mean over neighbouring texels of the same label
// only. Texels of no_label get 0. sigma in texels, > 0.
Grid<float> blur_within_labels(const Grid<float>& values, const Grid<std::uint8_t>& labels,
                               double sigma);

// Connected cells of one label, numbered in the order of their first cells.
template <class T>
struct LabelPatches {
  Grid<std::uint32_t> of_cell;
  std::vector<std::size_t> sizes;  // cells
  std::vector<T> labels;
};

// Patches are connected by sides, those of labels with `by_corners(label)` also by corners.
template <class T, class ByCorners>
LabelPatches<T> find_patches(const Grid<T>& cells, ByCorners by_corners) {
  std::vector<std::uint32_t> parent(cells.size());
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = static_cast<std::uint32_t>(i);
  const auto root = [&](std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const auto join = [&](std::size_t a, std::size_t b) {
    if (cells[a] != cells[b]) return;
    const std::uint32_t ra = root(static_cast<std::uint32_t>(a));
    const std::uint32_t rb = root(static_cast<std::uint32_t>(b));
    parent[std::max(ra, rb)] = std::min(ra, rb);
  };
  for (int y = 0; y < cells.height(); ++y)
    for (int x = 0; x < cells.width(); ++x) {
      const std::size_t i = cells.index(x, y);
      if (x > 0) join(i, cells.index(x - 1, y));
      if (y > 0) join(i, cells.index(x, y - 1));
      if (y == 0 || !by_corners(cells[i])) continue;
      if (x > 0) join(i, cells.index(x - 1, y - 1));
      if (x + 1 < cells.width()) join(i, cells.index(x + 1, y - 1));
    }
  LabelPatches<T> patches{Grid<std::uint32_t>(cells.width(), cells.height()), {}, {}};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::uint32_t first = root(static_cast<std::uint32_t>(i));
    if (first == i) {
      patches.of_cell[i] = static_cast<std::uint32_t>(patches.sizes.size());
      patches.sizes.push_back(0);
      patches.labels.push_back(cells[i]);
    } else {
      patches.of_cell[i] = patches.of_cell[first];
    }
    ++patches.sizes[patches.of_cell[i]];
  }
  return patches;
}

}  // namespace belvedere
