#pragma once

#include <cstdint>
#include <vector>

#include "terrain/layers/fit/fit_cells.h"

namespace belvedere {

struct ForestParameters {
  int trees = 50;          // ≥ 1
  int depth = 14;          // maximum number of splits from root to leaf, ≥ 1
  int leaf = 6;            // minimum number of cells in a leaf, ≥ 1
  std::uint64_t seed = 0;  // part of the stream layers_fit
};

// A node tests one input: samples up to `cut` go to `child`, the others to the node after it.
struct ForestNode {
  std::int32_t child = -1;  // -1: a leaf
  std::uint16_t input = 0;
  std::uint8_t cut = 0;
};
struct ForestTree {
  std::vector<ForestNode> nodes;
  std::vector<float> shares;  // [node · classes + class]
};
// Random forest (Breiman 2001): each tree is grown on half of the cells, drawn with replacement,
// with the best split by Gini's impurity among √inputs + 1 inputs at 64 thresholds. It cannot be
// stored in a layers file and serves as an upper reference for its accuracy. Implemented here
// because inputs are bytes: OpenCV's, which sorts floats, takes some fifty times as long, and its
// trees vote instead of averaging shares.
struct Forest {
  int classes = 0;
  std::vector<ForestTree> trees;
};
Forest fit_forest(const FitCells& cells, const ForestParameters& parameters = {});
ClassShares predict_shares(const Forest& forest,
                           const std::vector<std::vector<std::uint8_t>>& inputs);

}  // namespace belvedere
