#pragma once

namespace belvedere {

// How the terrain ends: not in a cliff, and not rubbed out either. Towards its end it stands ever deeper in air, so that mountains turn
// into blue silhouettes with their crests; only the last strip dissolves in what lies beyond, low ground before high.
struct TerrainEnd {
  float air = 0.0F;        // 0…1
  float dissolved = 0.0F;  // 0…1: share of what lies beyond
};

// `rim_m` is the distance on the ground to where the terrain ends, `fade_m` over which it fades (> 0); `raised` as in air_share.
TerrainEnd terrain_end_at(float rim_m, double fade_m, float raised);

}  // namespace belvedere
