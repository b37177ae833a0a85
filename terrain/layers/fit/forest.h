#pragma once

#include <cstdint>
#include <vector>

#include "terrain/layers/fit/fit_cells.h"

namespace belvedere {

struct ForestParameters {
  int trees = 50;          // ≥ 1
  int depth = 14;          // splits from root to leaf at most, ≥ 1
  int leaf = 6;            // cells in a leaf at least, ≥ 1
  std::uint64_t seed = 0;  // part of the stream layers_fit
};

// A node asks one input: samples up to `cut` go to `child`, the others to the node after it.
struct ForestNode {
  std::int32_t child = -1;  // -1: a leaf
  std::uint16_t input = 0;
  std::uint8_t cut = 0;
};
struct ForestTree {
  std::vector<ForestNode> nodes;
  std::vector<float> shares;  // [node · classes + class]
};
// Random decision trees (Breiman 2001): each grown on half of the cells, drawn with replacement, each split the best by Gini's measure
// among √inputs + 1 inputs at 64 places. No layers file can hold one: it says what a file leaves on the table. Our own, since inputs are
// bytes already: OpenCV's, which sorts floats, takes some fifty times as long, and its trees vote where these have shares.
struct Forest {
  int classes = 0;
  std::vector<ForestTree> trees;
};
Forest fit_forest(const FitCells& cells, const ForestParameters& parameters = {});
ClassShares predict_shares(const Forest& forest, const std::vector<std::vector<std::uint8_t>>& inputs);

}  // namespace belvedere
