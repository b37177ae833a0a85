#pragma once

#include <cstdint>
#include <vector>

#include "base/grid.h"
#include "terrain/layers/fit/clouds.h"
#include "terrain/layers/fit/clusters.h"
#include "terrain/layers/fit/colour_regions.h"
#include "terrain/layers/fit/ground_fit.h"

namespace belvedere {

struct PictureClassParameters {
  std::vector<ColourRegion> regions;  // empty: classes are found
  double chroma_sigma_cells = 2.5;    // ≥ 0, blur of colour against JPEG blocks
  double one_colour = 0.6;  // above this share of one class, lightness is used instead of hue
  int by_lightness = 5;     // number of classes then, 2…12
  CloudParameters clouds;
};

// Classes of the ground derived from the colours of a picture.
struct PictureClasses {
  std::vector<FitClass> classes;
  std::vector<std::uint8_t> labels;  // no_class: cloud, cloud shadow, not in use, in no region
  Clouds clouds;
  int parts = 0;            // components of the mixture; 0 with regions
  bool lightness = false;   // whether lightness was used
  double used_share = 0.0;  // of the picture
  double grey_share = 0.0;  // of the used cells
};
// `use`: 0 for cells to skip (voids, masked). Error(input) if less than a hundredth of the picture
// remains, or one class.
PictureClasses picture_classes(const Grid<glm::vec3>& picture, const Grid<float>& altitude_m,
                               double cell_m, const Grid<std::uint8_t>& use,
                               const PictureClassParameters& parameters = {});

}  // namespace belvedere
