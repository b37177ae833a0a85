#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// The statistics of a map of labels: which labels are next to which at which distance, the shape of
// borders, and the vertical distribution. A label map is itself a texture (Zalesny et al. 2005),
// but its values have no differences, so complete joint tables are kept.

inline constexpr int max_labels = 16;
inline constexpr int label_scales = 5;   // offsets are multiplied by 1, 2, 4, 8, 16
inline constexpr int label_offsets = 6;  // at each scale
inline constexpr int label_strips = 16;  // of height, from top to bottom
inline constexpr int ring_patterns = 256;

struct LabelOffset {
  int dx = 0;
  int dy = 0;
};
// From tail to head, at scale 0.
inline constexpr std::array<LabelOffset, label_offsets> label_steps = {
    {{1, 0}, {0, 1}, {1, 1}, {-1, 1}, {2, 0}, {0, 2}}};
// The eight pixels around one, in the order of a ring pattern's bits; also multiplied by the scale.
inline constexpr std::array<LabelOffset, 8> ring_steps = {
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

// Shares; every table sums to 1.
struct LabelMapModel {
  int labels = 0;  // 2…max_labels
  int crop_width = 0;
  int crop_height = 0;
  std::vector<float> pairs;  // of (tail, head), for each scale and offset: pair_table()
  std::vector<float> rings;  // of the patterns of equal labels around a pixel, for each scale: the
                             // shape of borders, which pairs do not determine
  std::vector<float> profile;  // of labels, for each strip; a row counts for the two strips between
                               // whose centres it lies

  std::size_t pair_table(int scale, int offset) const {
    return static_cast<std::size_t>(scale * label_offsets + offset) *
           static_cast<std::size_t>(labels) * static_cast<std::size_t>(labels);
  }
};

// The statistics of a map of labels 0 … count - 1. Error(input) for counts outside 2…16; Error(bug)
// for labels above the count.
LabelMapModel learn_label_map(const Grid<std::uint8_t>& labels, int count);

// The statistics adapted to a map of another size. Labels that are only ever above another (sky and
// sea) are layout: there is one per map, so the share of such pairs, and of rings along such
// borders, falls as the map grows, while that of pairs in both orders (patches) stays.
LabelMapModel at_size(const LabelMapModel& model, int width, int height);

// How similar a map is: L1 distances, 0…2, means over tables, patterns of all scales, strips.
struct LabelMapFigures {
  double pairs = 0.0;
  double pairs_for_size = 0.0;  // to the statistics adapted to its size: at_size
  double rings = 0.0;           // the same
  double profile = 0.0;
  // Share of neighbours, 1, 2, 4, 8, 16 pixels apart along rows and columns, that differ: the
  // length of borders at increasingly coarse scales.
  std::array<double, label_scales> borders{};
};
LabelMapFigures label_map_figures(const LabelMapModel& model, const Grid<std::uint8_t>& labels);
std::array<double, label_scales> border_shares(const LabelMapModel& model);

// Counts of a lattice of labels. They are integers, so the order of summation does not matter.
// Offsets beyond an edge are not counted.
using LabelCounts = std::vector<std::uint32_t>;
LabelCounts count_label_pairs(const Grid<std::uint8_t>& labels, int count, LabelOffset offset);
LabelCounts count_rings(const Grid<std::uint8_t>& labels, int step);
// Rows stand for every `step`-th row of a map `height` pixels high; in 256ths of a pixel.
std::vector<std::uint64_t> count_profile(const Grid<std::uint8_t>& labels, int count, int step,
                                         int height);
// The upper of the two strips between whose centres row y of a map lies, and the share of the lower
// one in 256ths.
struct StripPosition {
  int upper = 0;
  int lower_256 = 0;
};
StripPosition strip_position(int y, int height);

// The pattern of a pixel whose ring is entirely inside the map: one bit for each pixel of the ring
// that has the same label.
inline int ring_pattern(const Grid<std::uint8_t>& labels, int x, int y, int step) {
  const std::uint8_t own = labels(x, y);
  int pattern = 0;
  for (std::size_t k = 0; k < ring_steps.size(); ++k)
    pattern |= labels(x + step * ring_steps[k].dx, y + step * ring_steps[k].dy) == own ? 1 << k : 0;
  return pattern;
}

}  // namespace belvedere
