#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"

namespace belvedere {

struct SuperpixelParameters {
  int count = 400;       // pieces left, 2…16000; fewer if the picture has fewer pixels
  int cells = 2000;      // even cells that they are merged from, at least `count`, at most 60000
  double blur_px = 1.0;  // sigma of the blur before paint is compared, px
  double compactness = 0.08;  // colour difference equivalent to a cell's width, in units
                              // of the picture's values
  int rounds = 6;             // of moving the cells' centres
};

// A picture in connected pieces that follow its borders.
struct Superpixels {
  Grid<std::uint16_t> of;  // number of each pixel's piece, from 0 in the order of rows
  std::size_t count = 0;
};

// First even cells by simple linear iterative clustering (Achanta et al. 2012): centres on a
// honeycomb, each pixel to the centre nearest in colour and position, centres to the mean of their
// pixels, iterated. Then neighbours are merged, always the two whose merging adds the least
// variance per length of their border (Koepfler, Lopez & Morel 1994), until `count` are left. So
// flat skies get few pieces and fine detail such as rigging gets many. The picture may be in any
// perceptually uniform space.
Superpixels find_superpixels(const Grid<glm::vec3>& picture,
                             const SuperpixelParameters& parameters);

// Weight of each pair of things for being together (positive) or apart (negative): symmetric, the
// diagonal is ignored.
class PairWeights {
 public:
  explicit PairWeights(std::size_t count) : count_(count), weight_(count * count, 0.0) {}
  std::size_t count() const { return count_; }
  double operator()(std::size_t a, std::size_t b) const { return weight_[a * count_ + b]; }
  void set(std::size_t a, std::size_t b, double weight) {
    weight_[a * count_ + b] = weight_[b * count_ + a] = weight;
  }

 private:
  std::size_t count_;
  std::vector<double> weight_;
};

// The group of each thing, from 0 in order of appearance.
using Partition = std::vector<std::uint16_t>;

// Numbers groups again in order of appearance.
Partition in_order(const Partition& groups);

// Clique partitioning (Grötschel & Wakabayashi 1989): groups, as many as there happen to be, with a
// high sum of the weights of all pairs that share a group. The maximum is NP-hard to find; here the
// two groups with the largest mean weight between them are merged while that is positive, then
// single things move to the group with the largest gain until there is none. Ties go to the lower
// numbers, so the same weights give the same groups; at most 65,535 things.
Partition partition_cliques(const PairWeights& weights);

// The two steps separately. The moves start from any partition and never lower the objective.
Partition join_by_mean_weight(const PairWeights& weights);
Partition move_singly(const PairWeights& weights, const Partition& start);

}  // namespace belvedere
