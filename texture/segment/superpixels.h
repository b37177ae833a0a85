#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

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

}  // namespace belvedere
