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

// A picture in pieces, and the distances of all pairs: any grouping can be computed from it.
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
inline constexpr int min_segment_side = 32;

// Pieces of a picture in OKLab of about 200,000 pixels (segment_reduction). Error(input) for
// pictures under 32 pixels a side.
Segments find_segments(const Grid<glm::vec3>& oklab, const SegmentParameters& parameters = {});

// Groups of pieces: a pair's weight for sharing a group is `theta` minus its distance, times the
// area of the smaller piece. Small thetas give many groups, large ones few. The groups are not
// classes: the user merges and names them.
Partition group_pieces(const Segments& segments, double theta);
inline constexpr double usual_theta = 1.1;

// The factor by which a picture must be reduced to about 200,000 pixels; an integer, at least 1.
int segment_reduction(int width, int height);
// Means of blocks of factor × factor pixels; blocks at the right and lower edge may be smaller.
Grid<glm::vec3> reduce_blocks(const Grid<glm::vec3>& picture, int factor);
// Upsamples piece numbers found in the reduced picture to each pixel of the whole one: borders
// follow its colours within a pixel of the reduced one.
Grid<std::uint16_t> enlarge_pieces(const Grid<std::uint16_t>& of, const Grid<glm::vec3>& picture,
                                   int factor);

}  // namespace belvedere
