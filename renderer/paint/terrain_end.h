#pragma once

namespace belvedere {

// The end of the terrain: neither a cliff nor a plain fade. Air thickens towards it, so that
// mountains turn into blue silhouettes with their crests; only the last strip dissolves, low ground
// before high.
struct TerrainEnd {
  float air = 0.0F;        // 0…1
  float dissolved = 0.0F;  // 0…1: share of the colour beyond the terrain
};

// `rim_m`: distance on the ground to the edge of the terrain; `fade_m`: distance over which it
// fades (> 0); `raised` as in air_share.
TerrainEnd terrain_end_at(float rim_m, double fade_m, float raised);

}  // namespace belvedere
