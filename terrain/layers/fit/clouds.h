#pragma once

#include <cstdint>

#include "base/grid.h"
#include "terrain/layers/fit/fit_measures.h"

namespace belvedere {

struct CloudParameters {
  double white = 0.5;         // least value of greys that may be cloud, 0…1
  double whitest = 0.56;      // least value of pale colours that may be cloud, 0…1
  double pale = 0.25;         // most saturation of those, 0…1
  double dark = 0.24;         // most value of what may lie in a shadow that clouds are matched with, 0…1
  double shadow = 0.30;       // most value of what is taken for shadow at the place found, 0…1
  double least_m = 750.0;     // from cloud to shadow, along the ground
  double most_m = 5000.0;     // at most
  double least_match = 0.12;  // correlation of moved clouds with the dark from which on they are clouds
  double distinct = 0.75;     // what the best offset elsewhere may have of it at most: snow and dark woods match vaguely, in many places
};

// White things and the one way that all their shadows lie. Snow is as white as clouds are, but throws no shadows kilometres away: where no
// offset matches, nothing is cloud.
struct Clouds {
  bool found = false;
  Grid<std::uint8_t> cloud;      // 1: cloud, with a rim of three cells
  Grid<std::uint8_t> shadow;     // 1: in a cloud's shadow
  int shadow_x = 0;              // cells from a cloud to its shadow, to the east
  int shadow_y = 0;              // … to the south
  double elsewhere = 0.0;        // correlation at the best offset that is not near this one
  double match = 0.0;            // correlation there, -1…1
  double sun_azimuth_deg = 0.0;  // 0…360, towards the sun, clockwise from the picture's top
};
Clouds find_clouds(const Grid<glm::vec3>& picture, double cell_m, const CloudParameters& parameters = {});

}  // namespace belvedere
