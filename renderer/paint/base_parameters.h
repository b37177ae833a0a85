#pragma once

#include <cstdint>

namespace belvedere {

// Air, fields and hue drift: what turns ramps into the base picture. Distances are along the ray.
struct BaseParameters {
  double haze = 0.85;             // greatest share of air, 0…1
  double haze_from_m = 34000.0;   // air begins here, and the foreground's warmth ends about twice as far; ≥ 0
  double haze_scale_m = 62000.0;  // over this distance more the air closes to 1 - 1/e; > 0
  double haze_floor_m = 600.0;    // altitude up to which air is densest
  double range_mist = 1.0;        // separation of ranges, 0…3
  double warm_near = 1.0;         // 0…3
  double hue_drift = 1.0;         // 0…3: slow changes of hue over the ground, fields
  double rim_fade_m = 4000.0;     // over this distance the terrain stands ever deeper in air towards its end; 0 off
  double clouds = 1.0;            // 0 (none)…2
  double horizon_px = 0.0;        // row of the horizon in the whole picture (skyline_row_px of sky.h); 0: 0.18 of its height
  double sun_image_x = 1.0;       // as in ToneParameters
  double pixels_per_unit = 1.0;
  std::uint64_t seed = 1;
};

}  // namespace belvedere
