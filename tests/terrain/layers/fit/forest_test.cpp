#include "terrain/layers/fit/forest.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "terrain/layers/fit/fit_measures.h"
#include "tests/terrain/layers/fit/synthetic.h"

namespace belvedere {
namespace {

// A class of a square at the centre: no sum of functions of one input each represents it exactly,
// trees do.
FitCells square(std::size_t count, std::uint64_t seed) {
  FitCells cells = synthetic::two_classes(count, seed);
  for (std::size_t i = 0; i != count; ++i) {
    const bool in = cells.inputs[0][i] >= 64 && cells.inputs[0][i] < 192;
    const bool too = cells.inputs[1][i] >= 64 && cells.inputs[1][i] < 192;
    cells.labels[i] = in != too ? 1 : 0;
  }
  return cells;
}

TEST(Forest, LearnsWhatHangsOnTwoInputsTogether) {
  const FitCells evaluated = square(5'000, 12);
  const ClassShares shares = predict_shares(fit_forest(square(20'000, 11)), evaluated.inputs);
  EXPECT_GT(measure_classes(shares, evaluated.labels).accuracy, 0.97);
}

TEST(Forest, LeavesAreNoSmallerThanAsked) {
  const FitCells cells = square(4'000, 3);
  const Forest forest = fit_forest(cells, {.trees = 3, .depth = 20, .leaf = 50});
  for (const ForestTree& tree : forest.trees) {
    std::size_t leaves = 0;
    for (const ForestNode& node : tree.nodes) leaves += node.child < 0 ? 1 : 0;
    EXPECT_LE(leaves, 2'000U / 50U);
    EXPECT_GT(leaves, 4U);
  }
}

TEST(Forest, OneThreadOrTwoGiveTheSameShares) {
  const FitCells cells = square(6'000, 5);
  const auto many = predict_shares(fit_forest(cells, {.trees = 8}), cells.inputs).values;
  const ThreadLimit one(1);
  EXPECT_EQ(predict_shares(fit_forest(cells, {.trees = 8}), cells.inputs).values, many);
}

}  // namespace
}  // namespace belvedere
