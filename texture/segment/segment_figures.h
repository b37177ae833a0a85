#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// Agreement of groups of pixels with labels drawn by hand: intersection over union (IoU, Jaccard
// index), mean over the labels.
struct SegmentAgreement {
  double one_to_one = 0.0;  // each label matched with one group so that the sum is
                            // highest; 0 for unmatched labels
  double merged = 0.0;      // each group assigned to the label it covers most: the result of a user
                            // who merges groups
  double accuracy = 0.0;    // share of pixels with the right label after merging, 0…1
  std::size_t groups = 0;
};

// Labels of unknown_label, and those of fewer than `min_share` of all pixels, are ignored.
// Error(usage) if sizes differ.
inline constexpr std::uint8_t unknown_label = 255;
SegmentAgreement segment_agreement(const Grid<std::uint16_t>& groups,
                                   const Grid<std::uint8_t>& labels, double min_share = 0.005);

// For each row the matched column, each column once, so that the sum of the values is highest (Kuhn
// 1955, Munkres 1957); no_column for rows left over. `values` row by row, at least 0.
inline constexpr std::size_t no_column = static_cast<std::size_t>(-1);
std::vector<std::size_t> match_one_to_one(const std::vector<double>& values, std::size_t rows,
                                          std::size_t columns);

}  // namespace belvedere
