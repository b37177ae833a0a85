#pragma once

#include <cstdint>

#include "base/grid.h"
#include "terrain/layers/fit/fit_measures.h"

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
  double distinct = 0.75;   // maximum ratio of the best correlation elsewhere: snow and dark woods
                            // match vaguely, in many positions
};

// Detects white areas with a common direction to their shadows. Snow is as white as clouds but
// casts no shadows kilometres away: if no offset matches, nothing is cloud.
struct Clouds {
  bool found = false;
  Grid<std::uint8_t> cloud;      // 1: cloud, with a margin of three cells
  Grid<std::uint8_t> shadow;     // 1: in a cloud's shadow
  int shadow_x = 0;              // cells from a cloud to its shadow, to the east
  int shadow_y = 0;              // … to the south
  double elsewhere = 0.0;        // best correlation at offsets not near this one
  double match = 0.0;            // correlation at this offset, -1…1
  double sun_azimuth_deg = 0.0;  // 0…360, towards the sun, clockwise from the picture's top
};
Clouds find_clouds(const Grid<glm::vec3>& picture, double cell_m,
                   const CloudParameters& parameters = {});

}  // namespace belvedere
