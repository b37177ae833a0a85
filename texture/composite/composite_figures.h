#pragma once

#include "base/grid.h"
#include "texture/synthesis/exemplar.h"

namespace belvedere {

// What a texture of one kind cannot reproduce and a composite should: the distribution of colours
// over height, and the relation of distant pixels. L1 distances, 0…2, of a picture to its crop,
// which may be of another size.
struct LayoutFigures {
  double profile = 0.0;    // of colours in cells of 32 levels, in sixteen strips of height
  double far_pairs = 0.0;  // of differences of pixels 16, 32, 64 and 128 apart along rows and
                           // columns, in the crop's three bands
};
LayoutFigures layout_figures(const Grid<Rgb8>& crop, const Grid<Rgb8>& made);

}  // namespace belvedere
