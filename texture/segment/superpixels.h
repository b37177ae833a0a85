#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

#include "base/grid.h"

namespace belvedere {

struct SuperpixelParameters {
  int count = 400;            // pieces that are left, 2…16000; fewer where the picture has fewer pixels
  int cells = 2000;           // even cells that they are joined from, at least `count`, at most 60000
  double blur_px = 1.0;       // sigma of the blur that paint is looked at through, px
  double compactness = 0.08;  // colour difference that counts as much as a cell's width, in units of the picture's values
  int rounds = 6;             // of moving the cells' centres
};

// A picture in connected pieces that keep to its borders.
struct Superpixels {
  Grid<std::uint16_t> of;  // number of each pixel's piece, from 0 in the order of rows
  std::size_t count = 0;
};

// First even cells by simple linear iterative clustering (Achanta et al. 2012): centres on a honeycomb, each pixel to the centre nearest in
// colour and place, centres to the mean of their pixels, over and over. Then neighbours are joined whose border costs most for what it
// tells: the two whose joining adds the least variance per length of their border (Koepfler, Lopez & Morel 1994), until `count` are left.
// So flat skies take few pieces and rigging takes many. The picture in any space where equal steps look alike.
Superpixels find_superpixels(const Grid<glm::vec3>& picture, const SuperpixelParameters& parameters);

}  // namespace belvedere
