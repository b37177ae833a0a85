#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "renderer/paint/palette.h"

namespace belvedere {

// Kinds of clouds in a sky. any: fair, rows, streaks or banks, chosen by the picture's seed.
enum class SkyKind : std::uint8_t { any, fair, rows, streaks, banks, cumulus, front, evening };

// Aerial perspective: the change of colour with distance. Distances are along the ray.
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

// The air between the viewer and a position: how distance changes warmth and greens before air
// veils them. Distances along the ray, m.

// Share of air in front of a position, 0…1, before the palette's share: haze · (1 -
// exp(-(d/s)^1.35)), d measured from where air begins; it falls with altitude to .58 of that.
double haze_share(const AirParameters& parameters, double depth_m, double altitude_m);

// 0 in the foreground … 1 where ranges stand one behind the other in the air.
float farness(const AirParameters& parameters, double depth_m);

// 0 near … 1 where a third of a position's colour or more is air: far ranges are painted in wide
// masses. Before the palette's share.
float far_range_share(const AirParameters& parameters, double depth_m, double altitude_m);

// Share of air with the palette's share applied, 0…1. `far` is farness times the separation of
// ranges, 0…3; `raised` is the position relative to its surroundings, -1 valley … 1 crest: among
// far ranges crests get less air. Feet get no more than level ground at their distance, or the
// highest mountain, whose foot lies lowest beside it, would float.
float air_share(const AirParameters& parameters, const Palette& palette, double depth_m,
                double altitude_m, float far, float raised);

// Air turns from its near to its far colour between 30 and 100 km for the default distances.
glm::vec3 air_colour(const AirParameters& parameters, const Palette& palette, double depth_m);

// Warmth of the foreground: 1 up to .82 of the distance where air begins, 0 from 1.85 of it (28 and
// 63 km for 34 km).
float foreground_warmth(const AirParameters& parameters, double depth_m);

// How far greens have lost their freshness, 0 near … 1 at 1.5 times the distance where air begins:
// they desaturate before air veils them.
float green_desaturation(const AirParameters& parameters, double depth_m);

}  // namespace belvedere
