#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/layers/surface_layers.h"

namespace belvedere {

// The label of a cell that is not used for learning: cloud, shadow, masked, outside the legend.
inline constexpr std::uint8_t no_class = 255;

// Cells to learn from or to predict. Inputs are already quantized within their ranges, as samples
// 0…255 of functions (LayerSamples), so the fit has the same precision as the file.
struct FitCells {
  int classes = 0;                                // 1…64
  std::vector<std::vector<std::uint8_t>> inputs;  // [input][cell]
  std::vector<std::uint8_t> labels;               // [cell] below `classes`, or no_class

  std::size_t size() const { return labels.size(); }
};

// The cells at `indices`, in their order.
FitCells select_cells(const FitCells& cells, std::span<const std::uint32_t> indices);
// Indices of labelled cells, ascending; at most `most`, drawn uniformly (stream layers_fit,
// `part`).
std::vector<std::uint32_t> draw_labelled(std::span<const std::uint8_t> labels, std::size_t max,
                                         std::uint64_t part = 0);
// Number of cells of each label, without no_class.
std::vector<std::size_t> count_labels(std::span<const std::uint8_t> labels, int classes);

// The share of each class in each cell.
struct ClassShares {
  int classes = 0;
  std::vector<float> values;  // [cell · classes + class]; they sum to 1 per cell

  std::size_t size() const {
    return classes == 0 ? 0 : values.size() / static_cast<std::size_t>(classes);
  }
  std::span<const float> of(std::size_t cell) const {
    return std::span(values).subspan(cell * static_cast<std::size_t>(classes),
                                     static_cast<std::size_t>(classes));
  }
};
// The mean share of each class over the cells that have a label.
std::vector<double> mean_shares(const ClassShares& shares, std::span<const std::uint8_t> labels);
// The mixture weight · a + (1 - weight) · b.
ClassShares mix_shares(const ClassShares& a, const ClassShares& b, double weight);
// The most likely class of each cell by its share times the class's offset (empty: 1 each); ties to
// the lower class.
std::vector<std::uint8_t> most_likely(const ClassShares& shares,
                                      std::span<const double> offsets = {});
// Offsets for which the most likely classes cover the shares `wanted` of the ground (they sum to 1;
// a class of none stays out). Without them a class that is never the most likely, such as small
// lakes, would not appear.
std::vector<double> matching_offsets(const ClassShares& shares, std::span<const double> wanted);

}  // namespace belvedere
