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
  double chroma_sigma_cells = 2.5;    // ≥ 0, blur of colour against blocks of JPEG
  double one_colour = 0.6;            // where one class has more than this share, hue says too little and lightness divides
  int by_lightness = 5;               // classes there, 2…12
  CloudParameters clouds;
};

// What the colours of a picture say the ground is.
struct PictureClasses {
  std::vector<FitClass> classes;
  std::vector<std::uint8_t> labels;  // no_class: cloud, cloud shadow, not in use, in no region
  Clouds clouds;
  int parts = 0;            // of the mixture; 0 with regions
  bool lightness = false;   // whether lightness divides
  double used_share = 0.0;  // of the picture
  double grey_share = 0.0;  // of what is used
};
// `use`: 0 where nothing is to be learned (voids, masked). Error(input) where less than a hundredth of the picture is left, or one class.
PictureClasses picture_classes(const Grid<glm::vec3>& picture, const Grid<float>& altitude_m, double cell_m, const Grid<std::uint8_t>& use,
                               const PictureClassParameters& parameters = {});

}  // namespace belvedere
