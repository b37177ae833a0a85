#pragma once

#include <string>

#include "renderer/compose/coarse_ground.h"

namespace belvedere {

// The mean climate of a region's ground, as far as it determines the colours of a picture.
struct RegionClimate {
  bool known = false;          // position on the Earth
  double moisture = 1.0;       // 0…1: available share of the water that plants could use
  double low_moisture = 1.0;   // … on the ground below its mean altitude
  double rain_mm = 1000.0;     // a year
  double temperature_c = 5.0;  // of the year
};
RegionClimate region_climate(const CoarseGround& ground);

// The palette for a region: "desert" where is_canyon_country, else "high_desert" or "steppe" in dry
// country; empty where forest has enough water. `plateau`: share of ground that is a plateau, 0…1.
std::string dry_palette(const RegionClimate& climate, double plateau);

// Red cliffs and sage rather than meadows: dry, and warm enough not to be barren from cold.
bool is_canyon_country(const RegionClimate& climate);

}  // namespace belvedere
