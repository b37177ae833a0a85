#include "texture/segment/join_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace belvedere {
namespace {

// Remaining things to merge, by the number of each thing's first piece.
class Forest {
 public:
  Forest(const PairWeights& distance, const std::vector<double>& pixels, const Partition& groups)
      : count_(pixels.size()),
        pixels_(pixels),
        group_(groups),
        node_(count_),
        alive_(count_, true),
        sum_(count_ * count_),
        weight_(count_ * count_),
        root_(count_) {
    std::iota(node_.begin(), node_.end(), std::uint16_t{0});
    for (const double area : pixels) all_ += area;
    for (std::size_t a = 0; a < count_; ++a) update_root(a);
    for (std::size_t a = 0; a < count_; ++a)
      for (std::size_t b = 0; b < count_; ++b) {
        if (a == b) continue;
        weight_[a * count_ + b] = std::min(pixels[a], pixels[b]);
        sum_[a * count_ + b] = weight_[a * count_ + b] * distance(a, b);
      }
  }

  // Merges the best two of one group, or of any: false if there are none.
  bool join_best(bool within_groups, JoinTree& tree) {
    std::size_t first = count_;
    std::size_t second = count_;
    double min = std::numeric_limits<double>::infinity();
    for (std::size_t a = 0; a < count_; ++a) {
      if (!alive_[a]) continue;
      for (std::size_t b = a + 1; b < count_; ++b) {
        if (!alive_[b] || (within_groups && group_[a] != group_[b])) continue;
        const double cost =
            sum_[a * count_ + b] / weight_[a * count_ + b] * std::min(root_[a], root_[b]);
        if (cost < min) {
          min = cost;
          first = a;
          second = b;
        }
      }
    }
    if (first == count_) return false;
    tree.joins.push_back({node_[first], node_[second]});
    node_[first] = static_cast<std::uint16_t>(count_ + tree.joins.size() - 1);
    alive_[second] = false;
    pixels_[first] += pixels_[second];
    update_root(first);
    for (std::size_t c = 0; c < count_; ++c) {
      if (c == first || !alive_[c]) continue;
      sum_[first * count_ + c] += sum_[second * count_ + c];
      weight_[first * count_ + c] += weight_[second * count_ + c];
      sum_[c * count_ + first] = sum_[first * count_ + c];
      weight_[c * count_ + first] = weight_[first * count_ + c];
    }
    return true;
  }

 private:
  void update_root(std::size_t a) { root_[a] = std::sqrt(std::sqrt(pixels_[a] / all_)); }

  std::size_t count_;
  std::vector<double> pixels_;
  const Partition& group_;
  std::vector<std::uint16_t> node_;
  std::vector<bool> alive_;
  std::vector<double> sum_,
      weight_;  // of the distances between two things, and of the pairs they are means over
  std::vector<double> root_;
  double all_ = 0.0;
};

}  // namespace

JoinTree join_pieces(const PairWeights& distance, const std::vector<double>& pixels,
                     const Partition& groups) {
  JoinTree tree{pixels.size(), {}};
  Forest forest(distance, pixels, groups);
  while (forest.join_best(true, tree)) {
  }
  while (forest.join_best(false, tree)) {
  }
  return tree;
}

namespace {

// For each piece the node that contains it when `count` are left.
std::vector<std::uint16_t> nodes_of_pieces(const JoinTree& tree, std::size_t count) {
  const std::size_t kept = tree.pieces - std::min(std::max<std::size_t>(count, 1), tree.pieces);
  // From the last counted join downwards: each node passes its group to its two parts.
  std::vector<std::uint16_t> of(tree.pieces + tree.joins.size());
  std::iota(of.begin(), of.end(), std::uint16_t{0});
  for (std::size_t k = kept; k-- > 0;)
    for (const std::uint16_t part : tree.joins[k]) of[part] = of[tree.pieces + k];
  of.resize(tree.pieces);
  return of;
}

}  // namespace

Partition cut_tree(const JoinTree& tree, std::size_t count) {
  return in_order(nodes_of_pieces(tree, count));
}

std::vector<std::uint16_t> cut_nodes(const JoinTree& tree, std::size_t count) {
  std::vector<std::uint16_t> nodes;
  for (const std::uint16_t node : nodes_of_pieces(tree, count))
    if (std::find(nodes.begin(), nodes.end(), node) == nodes.end()) nodes.push_back(node);
  return nodes;
}

}  // namespace belvedere
