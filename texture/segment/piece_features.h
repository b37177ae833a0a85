#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"
#include "texture/segment/clique_partition.h"
#include "texture/segment/superpixels.h"

namespace belvedere {

// How unlike two pieces of a picture are; 1 is a difference that anyone sees at once. The picture is in OKLab, of about 200,000 pixels:
// lengths are in its pixels.
struct PieceDistanceParameters {
  double colour_blur_px = 3.0;  // sigma
  double lightness_gain = 8.3;  // of the picture's x
  double colour_gain = 37.5;    // of y and z
  double texture_gain = 0.55;   // of each of the nine responses of the filter bank
  double down_gain = 1.8;       // of the place, from the upper edge to the lower: sky is above
  double across_gain = 0.6;     // and from side to side
  double border_blur_px = 1.5;  // of the paint that is compared across a border
  double way_gain = 0.1;        // of the way between two pieces, over borders of pieces: what contours part is apart
  double way_free = 0.3;        // what a border may differ by and be free
  double way_most = 4.0;        // no way counts more
  double neighbour_gain = 1.0;  // neighbours are as much more alike as what differs across their border is
  double neighbour_step = 2.0;  // less than this
};

// Means over the pieces: colour; how strongly lightness changes along rows, along columns and at spots, at sigmas of 1, 2 and 4 pixels
// (logarithms of smoothed magnitudes); place. `dimensions` values a piece, scaled by the gains.
struct PieceFeatures {
  std::size_t dimensions = 0;
  std::vector<double> values;
  std::vector<double> pixels;  // of each piece
  double distance(std::size_t a, std::size_t b) const;
};
PieceFeatures measure_pieces(const Grid<glm::vec3>& oklab, const Superpixels& pieces, const PieceDistanceParameters& parameters);

// Distances of all pairs: the features', and the cheapest way over borders, square and square together; of neighbours less what their
// border lacks of a contour, which may leave less than nothing.
PairWeights piece_distances(const Grid<glm::vec3>& oklab, const Superpixels& pieces, const PieceFeatures& features,
                            const PieceDistanceParameters& parameters);

}  // namespace belvedere
