#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "texture/segment/clique_partition.h"

namespace belvedere {

// Pieces merged pairwise until one is left. Nodes 0 … pieces - 1 are the pieces; join k makes node
// pieces + k from two earlier nodes.
struct JoinTree {
  std::size_t pieces = 0;
  std::vector<std::array<std::uint16_t, 2>> joins;  // pieces - 1 of them
};

// First within each group of `groups` until it is one, so that every group is a node, then the
// groups. The next two are always those with the smallest product of mean distance (a pair has the
// weight of its smaller piece) and fourth root of the smaller one's share of the picture: crumbs
// are merged before large things that are slightly more similar. Distances may be negative; at most
// 32,000 pieces.
JoinTree join_pieces(const PairWeights& distance, const std::vector<double>& pixels,
                     const Partition& groups);

// The tree cut where `count` groups are left, or as many as there are pieces.
Partition cut_tree(const JoinTree& tree, std::size_t count);
// The nodes of those groups, in order.
std::vector<std::uint16_t> cut_nodes(const JoinTree& tree, std::size_t count);

}  // namespace belvedere
