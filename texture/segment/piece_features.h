#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "base/grid.h"
#include "texture/segment/clique_partition.h"
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

}  // namespace belvedere
