#include "terrain/layers/fit/forest.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "base/parallel.h"
#include "base/random.h"

namespace belvedere {
namespace {

constexpr std::size_t bins = 64;  // splits are between bins of 4 samples
constexpr int samples_per_bin = 4;

struct Split {
  double gain = 0.0;
  std::size_t input = 0;
  std::size_t bin = 0;
};

// Sum of squared counts over their sum: Gini's impurity criterion; larger is purer.
double purity(const std::vector<std::uint32_t>& counts, double total) {
  double squares = 0.0;
  for (const std::uint32_t c : counts) squares += static_cast<double>(c) * static_cast<double>(c);
  return total > 0.0 ? squares / total : 0.0;
}

class TreeGrower {
 public:
  TreeGrower(const FitCells& cells, const std::vector<std::uint8_t>& rows,
             const ForestParameters& parameters, std::uint64_t seed)
      : classes_(static_cast<std::size_t>(cells.classes)),
        inputs_(cells.inputs.size()),
        labels_(cells.labels),
        rows_(rows),
        parameters_(parameters),
        seed_(seed),
        take_(std::min(
            inputs_,
            static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(inputs_)))) + 1)) {}

  // `cells` are the drawn ones; they are reordered so that each node's are contiguous.
  ForestTree grow(std::vector<std::uint32_t> cells) {
    cells_ = std::move(cells);
    add_node(0, cells_.size());
    struct Open {
      std::size_t node, begin, end;
      int depth;
    };
    std::vector<Open> open{{0, 0, cells_.size(), 0}};
    while (!open.empty()) {
      const Open o = open.back();
      open.pop_back();
      if (o.depth == parameters_.depth) continue;
      const Split split = best_split(o.node, o.begin, o.end);
      if (!(split.gain > 1e-9)) continue;
      const auto centre = static_cast<std::size_t>(
          std::stable_partition(
              cells_.begin() + static_cast<std::ptrdiff_t>(o.begin),
              cells_.begin() + static_cast<std::ptrdiff_t>(o.end),
              [&](std::uint32_t c) { return bin_of(c, split.input) <= split.bin; }) -
          cells_.begin());
      const std::size_t child = tree_.nodes.size();
      add_node(o.begin, centre);
      add_node(centre, o.end);
      tree_.nodes[o.node] = {
          static_cast<std::int32_t>(child), static_cast<std::uint16_t>(split.input),
          static_cast<std::uint8_t>(split.bin * samples_per_bin + samples_per_bin - 1)};
      open.push_back({child + 1, centre, o.end, o.depth + 1});
      open.push_back({child, o.begin, centre, o.depth + 1});
    }
    return std::move(tree_);
  }

 private:
  std::size_t bin_of(std::uint32_t cell, std::size_t input) const {
    return rows_[cell * inputs_ + input] / samples_per_bin;
  }

  void add_node(std::size_t begin, std::size_t end) {
    tree_.nodes.emplace_back();
    std::vector<std::uint32_t> counts(classes_, 0);
    for (std::size_t i = begin; i != end; ++i) ++counts[labels_[cells_[i]]];
    for (const std::uint32_t c : counts)
      tree_.shares.push_back(static_cast<float>(c) /
                             static_cast<float>(std::max<std::size_t>(end - begin, 1)));
  }

  // The inputs available to a node: the first of a shuffle keyed by the node.
  std::vector<std::size_t> inputs_to_try(std::size_t node) const {
    std::vector<std::size_t> order(inputs_);
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t i = 0; i != take_; ++i) {
      const std::uint32_t j =
          random_index(static_cast<std::uint32_t>(inputs_ - i), seed_,
                       static_cast<std::int64_t>(node), static_cast<std::int64_t>(i), 1);
      std::swap(order[i], order[i + j]);
    }
    order.resize(take_);
    return order;
  }

  Split best_split(std::size_t node, std::size_t begin, std::size_t end) const {
    Split best;
    const std::size_t count = end - begin;
    const auto leaf = static_cast<std::size_t>(parameters_.leaf);
    if (count < 2 * leaf) return best;
    std::vector<std::uint32_t> total(classes_, 0);
    for (std::size_t i = begin; i != end; ++i) ++total[labels_[cells_[i]]];
    const double before = purity(total, static_cast<double>(count));
    for (const std::size_t a : inputs_to_try(node)) {
      std::vector<std::uint32_t> histogram(bins * classes_, 0);
      for (std::size_t i = begin; i != end; ++i)
        ++histogram[bin_of(cells_[i], a) * classes_ + labels_[cells_[i]]];
      std::vector<std::uint32_t> left(classes_, 0);
      std::vector<std::uint32_t> right = total;
      std::size_t on_left = 0;
      for (std::size_t b = 0; b + 1 != bins; ++b) {
        for (std::size_t k = 0; k != classes_; ++k) {
          const std::uint32_t moved = histogram[b * classes_ + k];
          left[k] += moved;
          right[k] -= moved;
          on_left += moved;
        }
        if (on_left < leaf || count - on_left < leaf) continue;
        const double gain = (purity(left, static_cast<double>(on_left)) +
                             purity(right, static_cast<double>(count - on_left)) - before) /
                            static_cast<double>(count);
        if (gain > best.gain) best = {gain, a, b};
      }
    }
    return best;
  }

  std::size_t classes_;
  std::size_t inputs_;
  const std::vector<std::uint8_t>& labels_;
  const std::vector<std::uint8_t>& rows_;
  const ForestParameters& parameters_;
  std::uint64_t seed_;
  std::size_t take_;
  std::vector<std::uint32_t> cells_;
  ForestTree tree_;
};

}  // namespace

Forest fit_forest(const FitCells& cells, const ForestParameters& parameters) {
  const std::vector<std::uint32_t> labelled = draw_labelled(cells.labels, cells.size());
  const std::size_t inputs = cells.inputs.size();
  std::vector<std::uint8_t> rows(cells.size() * inputs);
  for (std::size_t a = 0; a != inputs; ++a)
    for (std::size_t i = 0; i != cells.size(); ++i) rows[i * inputs + a] = cells.inputs[a][i];
  Forest forest{cells.classes, std::vector<ForestTree>(static_cast<std::size_t>(parameters.trees))};
  parallel_ranges(forest.trees.size(), std::size_t{1}, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t != end; ++t) {
      const std::uint64_t seed = stream_seed(parameters.seed, Stream::layers_fit, 1000 + t);
      std::vector<std::uint32_t> drawn(labelled.size() / 2);
      for (std::size_t i = 0; i != drawn.size(); ++i)
        drawn[i] = labelled[random_index(static_cast<std::uint32_t>(labelled.size()), seed,
                                         static_cast<std::int64_t>(i), 0)];
      forest.trees[t] = TreeGrower(cells, rows, parameters, seed).grow(std::move(drawn));
    }
  });
  return forest;
}

ClassShares predict_shares(const Forest& forest,
                           const std::vector<std::vector<std::uint8_t>>& inputs) {
  const auto classes = static_cast<std::size_t>(forest.classes);
  const std::size_t cells = inputs.empty() ? 0 : inputs[0].size();
  ClassShares shares{forest.classes, std::vector<float>(cells * classes, 0.0F)};
  const float weight = 1.0F / static_cast<float>(forest.trees.size());
  parallel_ranges(cells, std::size_t{4096}, [&](std::size_t begin, std::size_t end) {
    for (const ForestTree& tree : forest.trees)
      for (std::size_t c = begin; c != end; ++c) {
        std::size_t node = 0;
        while (tree.nodes[node].child >= 0) {
          const ForestNode& n = tree.nodes[node];
          node = static_cast<std::size_t>(n.child) + (inputs[n.input][c] <= n.cut ? 0 : 1);
        }
        for (std::size_t k = 0; k != classes; ++k)
          shares.values[c * classes + k] += weight * tree.shares[node * classes + k];
      }
  });
  return shares;
}

}  // namespace belvedere
