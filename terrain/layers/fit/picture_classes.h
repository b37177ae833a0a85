#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/grid.h"
#include "terrain/layers/fit/clusters.h"
#include "terrain/layers/fit/colour_regions.h"
#include "terrain/layers/fit/fit_measures.h"
#include "terrain/layers/fit/ground_fit.h"

namespace belvedere {

struct CloudParameters {
  double white = 0.5;       // minimum value of greys that may be cloud, 0…1
  double whitest = 0.56;    // minimum value of pale colours that may be cloud, 0…1
  double pale = 0.25;       // maximum saturation of those, 0…1
  double dark = 0.24;       // maximum value of shadow candidates for matching, 0…1
  double shadow = 0.30;     // maximum value of shadow at the matched position, 0…1
  double min_m = 750.0;     // from cloud to shadow, along the ground
  double max_m = 5000.0;    // at most
  double min_match = 0.12;  // minimum correlation of shifted clouds with dark cells
  double snow_index =
      0.4;  // (green - swir) / (green + swir) above which white is snow (Dozier 1989)
  double distinct = 0.75;  // maximum ratio of the best correlation elsewhere: snow and dark woods
                           // match vaguely, in many positions
};

// Detects white areas with a common direction to their shadows. Snow is as white as clouds but
// casts no shadows kilometres away: if no offset matches, nothing is cloud. With a shortwave
// infrared band (`swir`, in the unit of the picture), in which snow is dark, white is cloud where
// it is bright there, with or without shadows.
struct Clouds {
  bool found = false;
  bool shadows = false;          // found by the offset of their shadows, so that the sun is known
  Grid<std::uint8_t> cloud;      // 1: cloud, with a margin of three cells
  Grid<std::uint8_t> shadow;     // 1: in a cloud's shadow
  int shadow_x = 0;              // cells from a cloud to its shadow, to the east
  int shadow_y = 0;              // the same, to the south
  double elsewhere = 0.0;        // best correlation at offsets not near this one
  double match = 0.0;            // correlation at this offset, -1…1
  double sun_azimuth_deg = 0.0;  // 0…360, towards the sun, clockwise from the picture's top
};
Clouds find_clouds(const Grid<glm::vec3>& picture, double cell_m,
                   const CloudParameters& parameters = {}, const Grid<float>* swir = nullptr);

struct PictureClassParameters {
  std::vector<ColourRegion> regions;  // empty: classes are found
  double chroma_sigma_cells = 2.5;    // ≥ 0, blur of colour against JPEG blocks
  double one_colour = 0.6;  // above this share of one class, lightness is used instead of hue
  int by_lightness = 5;     // number of classes then, 2…12
  CloudParameters clouds;
  const Grid<float>* swir = nullptr;  // for clouds
  // Hue that greys get, as first published (a hue that the picture has not); none: greys lie
  // between all hues.
  std::optional<double> grey_hue_deg;
  // White below this altitude is not snow and is left out.
  double snow_from_m = -std::numeric_limits<double>::infinity();
};

// Classes of the ground derived from the colours of a picture.
struct PictureClasses {
  std::vector<FitClass> classes;
  std::vector<std::uint8_t> labels;  // no_class: cloud, cloud shadow, not in use, in no region
  Clouds clouds;
  int parts = 0;                 // components of the mixture; 0 with regions
  bool lightness = false;        // whether lightness was used
  double used_share = 0.0;       // of the picture
  double grey_share = 0.0;       // of the used cells
  double low_white_share = 0.0;  // of the picture: white below snow_from_m
};
// `use`: 0 for cells to skip (voids, masked). Error(input) if less than a hundredth of the picture
// remains, or one class.
PictureClasses picture_classes(const Grid<glm::vec3>& picture, const Grid<float>& altitude_m,
                               double cell_m, const Grid<std::uint8_t>& use,
                               const PictureClassParameters& parameters = {});

}  // namespace belvedere
