#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/layers/surface_layers.h"

namespace belvedere {

// The label of a cell that is not to be learned from: cloud, shadow, masked, outside the legend.
inline constexpr std::uint8_t no_class = 255;

// Cells to learn from or to predict. Inputs are already places in their ranges, as samples 0…255 of functions (LayerSamples): what the file
// keeps of a function is all that the fit sees of it.
struct FitCells {
  int classes = 0;                                // 1…64
  std::vector<std::vector<std::uint8_t>> inputs;  // [input][cell]
  std::vector<std::uint8_t> labels;               // [cell] below `classes`, or no_class

  std::size_t size() const { return labels.size(); }
};

// The cells at `indices`, in their order.
FitCells select_cells(const FitCells& cells, std::span<const std::uint32_t> indices);
// Indices of labelled cells, ascending; where they are more than `most`, that many of them, drawn evenly (stream layers_fit, `part`).
std::vector<std::uint32_t> draw_labelled(std::span<const std::uint8_t> labels, std::size_t most, std::uint64_t part = 0);
// Cells of each label, no_class left out.
std::vector<std::size_t> count_labels(std::span<const std::uint8_t> labels, int classes);

// The share of each class in each cell.
struct ClassShares {
  int classes = 0;
  std::vector<float> values;  // [cell · classes + class], of a cell they add up to 1

  std::size_t size() const { return classes == 0 ? 0 : values.size() / static_cast<std::size_t>(classes); }
  std::span<const float> of(std::size_t cell) const {
    return std::span(values).subspan(cell * static_cast<std::size_t>(classes), static_cast<std::size_t>(classes));
  }
};
// The mean share of each class over the cells that have a label.
std::vector<double> mean_shares(const ClassShares& shares, std::span<const std::uint8_t> labels);
// weight · a + (1 - weight) · b.
ClassShares mix_shares(const ClassShares& a, const ClassShares& b, double weight);
// The most likely class of each cell, its share times the class's offset (empty: 1 each); ties to the lower class.
std::vector<std::uint8_t> most_likely(const ClassShares& shares, std::span<const double> offsets = {});
// Offsets under which the most likely classes cover `wanted` (shares of the ground, adding up to 1; a class of none stays out). Without
// them a class that is nowhere the most likely, as small lakes, never shows.
std::vector<double> matching_offsets(const ClassShares& shares, std::span<const double> wanted);

}  // namespace belvedere
