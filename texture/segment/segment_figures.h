#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/grid.h"

namespace belvedere {

// How well groups of pixels agree with labels drawn by hand: intersection over union (IoU, Jaccard index), mean over the labels.
struct SegmentAgreement {
  double one_to_one = 0.0;  // each label beside one group of its own, matched so that the sum is highest; 0 for those left over
  double merged = 0.0;      // each group counted to the label it covers most of: what whoever merges groups by clicks arrives at
  double accuracy = 0.0;    // pixels that merged groups label right, 0…1
  std::size_t groups = 0;
};

// Labels of unknown_label, and those of fewer than `least_share` of all pixels, count nowhere. Error(usage) where sizes disagree.
inline constexpr std::uint8_t unknown_label = 255;
SegmentAgreement segment_agreement(const Grid<std::uint16_t>& groups, const Grid<std::uint8_t>& labels, double least_share = 0.005);

// For each row the column that it is matched with, each column once, so that the sum of the values is highest (Kuhn 1955, Munkres 1957);
// no column where there are more rows than columns and others have more of it. `values` row by row, at least 0.
inline constexpr std::size_t no_column = static_cast<std::size_t>(-1);
std::vector<std::size_t> match_one_to_one(const std::vector<double>& values, std::size_t rows, std::size_t columns);

}  // namespace belvedere
