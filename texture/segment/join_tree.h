#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "texture/segment/clique_partition.h"

namespace belvedere {

// Pieces joined two by two until all are one. Nodes 0 … pieces - 1 are the pieces; join k makes node pieces + k of two that stand before
// it.
struct JoinTree {
  std::size_t pieces = 0;
  std::vector<std::array<std::uint16_t, 2>> joins;  // pieces - 1 of them
};

// First within each group of `groups` until it is one, so that every group is a node, then the groups. The next two are always those whose
// pieces are most alike (mean of their distances, a pair counting as much as its smaller piece) times the fourth root of the smaller one's
// share of the picture: crumbs are joined before large things that are hardly less alike. Distances may be negative; at most 32,000 pieces.
JoinTree join_pieces(const PairWeights& distance, const std::vector<double>& pixels, const Partition& groups);

// The tree cut where `count` groups are left, or as many as there are pieces.
Partition cut_tree(const JoinTree& tree, std::size_t count);
// The nodes that those groups are, in their order.
std::vector<std::uint16_t> cut_nodes(const JoinTree& tree, std::size_t count);

}  // namespace belvedere
