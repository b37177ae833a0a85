#pragma once

#include "renderer/compose/coarse_ground.h"

namespace belvedere {

// The climate of a region on the mean over its ground, as far as it decides the colours of a picture.
struct RegionClimate {
  bool known = false;          // where on Earth it lies
  double moisture = 1.0;       // 0…1: share of the water that plants could use which they get
  double rain_mm = 1000.0;     // a year
  double temperature_c = 5.0;  // of the year
};
RegionClimate region_climate(const CoarseGround& ground);

// Red cliffs and sage rather than meadows: dry, and warm enough not to be bare for cold.
bool is_canyon_country(const RegionClimate& climate);

}  // namespace belvedere
