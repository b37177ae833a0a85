#pragma once

#include <cstdint>
#include <glm/vec2.hpp>

#include "base/guidance_buffers.h"

namespace belvedere {

// The end of the terrain: neither a cliff nor a plain fade. Air thickens towards it, so that
// mountains turn into blue silhouettes; only the last strip dissolves. Both depend on the distance
// to the end alone, never on height: along a line of sight towards the end nothing fades more than
// what stands behind it, so no summit floats over a foot that is gone.
struct TerrainEnd {
  float air = 0.0F;        // 0…1
  float dissolved = 0.0F;  // 0…1: share of the colour beyond the terrain
};

// `rim_m`: distance on the ground to the edge of the terrain; `fade_m`: distance over which it
// fades (> 0).
TerrainEnd terrain_end_at(float rim_m, double fade_m);

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

// Edges where one range stands in front of another: mist lightens the far side, the near side
// darkens, and accents of light are set on the edge.

// Logarithm of the depth (m, at least 1). The sky counts as slightly farther than the terrain up to
// `reach_px` below it, so that the skyline gets no halo.
Grid<float> log_depths(const GuidanceBuffers& guidance, int reach_px);

// Effect of the edge on a pixel whose log depth exceeds the mean around it by `behind`. `far` and
// `raised` as in air_share: mist lies in valleys, crests stay clear. `strength` is
// AirParameters::range_mist, 0…3.
struct RangeEdge {
  float mist = 0.0F;  // share of the colour between ranges
  float dark = 0.0F;  // 0…1, of the near side
};
RangeEdge range_edge(float behind, float far, float raised, float strength);

// Mist in the hollows of far ranges, of unlike depth: deep here, none there. The first is where it
// may lie, 0…1 for every pixel of a window of the sheet; the second its share of the colour there,
// before farness: less on level floors, whose rivers and places stay in view.
Grid<float> hollow_mist_places(std::uint64_t seed, glm::ivec2 origin_px, int width, int height,
                               double pixels_per_unit);
float hollow_mist(float place, float relief_l_m, float slope_deg, float strength);

// The largest share that mist at a range's edge may have where mist in hollows already has `mist`:
// together they are a veil, so that a far mountain stands on a foot and does not float.
float edge_mist_beside(float mist, float strength);

// Light on the nearer side of a depth edge, ridges and hollows: -1 hollow … +1 edge. Reads
// `step_px` to each side, up to three times. The skyline gets no accents: a light rim against the
// sky looks cut out.
float accent_at(const GuidanceBuffers& guidance, const Grid<float>& log_depth, int x, int y,
                int step_px);

}  // namespace belvedere
