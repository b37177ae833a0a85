#pragma once

#include <cstdint>

namespace belvedere {

// Kinds of clouds in a sky. any: fair, rows, streaks or banks, chosen by the picture's seed.
enum class SkyKind : std::uint8_t { any, fair, rows, streaks, banks, cumulus, front, evening };

// What distance does to colour. Distances are along the ray.
struct AirParameters {
  double haze = 0.85;  // maximum share of air, 0…1
  double from_m =
      34000.0;  // air begins here, and the foreground's warmth ends about twice as far; ≥ 0
  double scale_m = 62000.0;    // distance over which the share of air reaches 1 - 1/e; > 0
  double floor_m = 600.0;      // altitude up to which air is densest; not a scene key
  double range_mist = 1.0;     // separation of ranges, 0…3
  double warm_near = 1.0;      // 0…3
  double hue_drift = 1.0;      // 0…3: slow changes of hue over the ground, fields
  double rim_fade_m = 4000.0;  // distance over which air thickens towards the terrain's end; 0 off
  double clouds = 1.0;         // 0 (none)…2
  SkyKind sky = SkyKind::any;
};

}  // namespace belvedere
