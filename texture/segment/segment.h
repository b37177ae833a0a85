#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"
#include "texture/segment/clique_partition.h"
#include "texture/segment/join_tree.h"
#include "texture/segment/piece_features.h"
#include "texture/segment/superpixels.h"

namespace belvedere {

// A picture in pieces, and how unlike each two of them are: whatever groups are asked for can be made of it at once.
struct Segments {
  Superpixels pieces;
  std::vector<double> pixels;  // of each piece
  PairWeights distance{0};
};

struct SegmentParameters {
  SuperpixelParameters pieces;
  PieceDistanceParameters distance;
};

// Side of the smallest pictures that can be segmented, px.
inline constexpr int least_segment_side = 32;

// Pieces of a picture in OKLab of about 200,000 pixels (segment_reduction). Error(input) for pictures under 32 pixels a side.
Segments find_segments(const Grid<glm::vec3>& oklab, const SegmentParameters& parameters = {});

// Pieces that belong together: a pair wants to share a group as far as it is more alike than `theta`, times the area of the smaller one.
// Small thetas give many groups, large ones few: groups to be merged and named by whoever knows what is painted, not classes.
Partition group_pieces(const Segments& segments, double theta);
inline constexpr double usual_theta = 1.1;

// How many times a picture must be reduced, so that about 200,000 pixels are left; a whole number, at least 1.
int segment_reduction(int width, int height);
// Means of blocks of factor × factor pixels; blocks at the right and lower edge may be smaller.
Grid<glm::vec3> reduce_blocks(const Grid<glm::vec3>& picture, int factor);
// Numbers found in the picture reduced so, for each pixel of the whole one: borders follow its colours within a pixel of the reduced one.
Grid<std::uint16_t> enlarge_pieces(const Grid<std::uint16_t>& of, const Grid<glm::vec3>& picture, int factor);

}  // namespace belvedere
