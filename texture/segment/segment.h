#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"
#include "texture/segment/superpixels.h"

namespace belvedere {

// Dissimilarity of two pieces of a picture; 1 is immediately visible. The picture is in OKLab, of
// about 200,000 pixels: lengths are in its pixels.
struct PieceDistanceParameters {
  double colour_blur_px = 3.0;  // sigma
  double lightness_gain = 8.3;  // of the picture's x
  double colour_gain = 37.5;    // of y and z
  double texture_gain = 0.55;   // of each of the nine responses of the filter bank
  double down_gain = 1.8;       // of the vertical position: sky is above
  double across_gain = 0.6;     // of the horizontal position
  double border_blur_px = 1.5;  // of the paint compared across a border
  double way_gain =
      0.1;  // of the path between two pieces, across borders: contours separate pieces
  double way_free = 0.3;        // difference across a border that costs nothing
  double way_max = 4.0;         // max difference that counts
  double neighbour_gain = 1.0;  // factor on (neighbour_step - difference across the border), by
                                // which the distance of neighbours is reduced
  double neighbour_step = 2.0;  // typical difference across a contour
};

// Means over the pieces: colour; magnitude of lightness changes along rows, along columns and at
// spots, at sigmas of 1, 2 and 4 pixels (logarithms of smoothed magnitudes); position. `dimensions`
// values per piece, scaled by the gains.
struct PieceFeatures {
  std::size_t dimensions = 0;
  std::vector<double> values;
  std::vector<double> pixels;  // of each piece
  double distance(std::size_t a, std::size_t b) const;
};
PieceFeatures measure_pieces(const Grid<glm::vec3>& oklab, const Superpixels& pieces,
                             const PieceDistanceParameters& parameters);

// Distances of all pairs: root of the sum of squares of the features' distance and of the cheapest
// path over borders. For neighbours it is reduced by what their border lacks of a contour, possibly
// below 0.
PairWeights piece_distances(const Grid<glm::vec3>& oklab, const Superpixels& pieces,
                            const PieceFeatures& features,
                            const PieceDistanceParameters& parameters);

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
