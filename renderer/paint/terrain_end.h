#pragma once

#include <glm/vec2.hpp>

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

// Where terrain ends beside the line of sight, its cut would stand upright in the picture. There
// it fades over a width of the sheet instead of a distance on the ground, crests as well, along a
// ragged line.
struct TerrainSides {
  glm::dvec2 low{0.0}, high{0.0};  // corners of the data, scene CRS
  glm::dvec2 viewer{0.0};          // scene CRS
};
// A position on the ground and on the sheet. Units of the sheet.
struct SidePlace {
  glm::dvec2 position{0.0};      // within the data, scene CRS
  double metres_per_unit = 1.0;  // > 0
  double from_left_units = 0.0;
  double sheet_width_units = 0.0;
};
// How near to an upright cut that the picture shows a place is: 1 there … 0.
float side_share(const TerrainSides& sides, const SidePlace& place);
// `noise` of deviation about 1 makes the line ragged.
TerrainEnd with_sides(TerrainEnd end, float side, float noise);

}  // namespace belvedere
