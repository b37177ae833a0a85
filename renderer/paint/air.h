#pragma once

#include <glm/vec3.hpp>

#include "renderer/paint/air_parameters.h"
#include "renderer/paint/palette.h"

namespace belvedere {

// The air between the eye and a place, and what distance does to warmth and greens before air veils them. Distances along the ray, m.

// Share of air in front of a place, 0…1, before the palette's share: haze · (1 - exp(-(d/s)^1.35)) from where air begins, thinner with
// altitude down to .58 of it.
double haze_share(const AirParameters& parameters, double depth_m, double altitude_m);

// 0 in the foreground … 1 where ranges lie one behind the other in the air.
float farness(const AirParameters& parameters, double depth_m);

// The share with the palette's, 0…1. `far` is farness times the separation of ranges, 0…3; `raised` says how a place stands against its
// surroundings, -1 valley … 1 crest: among far ranges the feet stand deeper in air and the crests out of it.
float air_share(const AirParameters& parameters, const Palette& palette, double depth_m, double altitude_m, float far, float raised);

// Air turns from its near to its far colour between 30 and 100 km for the default distances.
glm::vec3 air_colour(const AirParameters& parameters, const Palette& palette, double depth_m);

// How far the warm foreground reaches: 1 up to .82 of where air begins, nothing at 1.85 of it (28 and 63 km for 34 km).
float foreground_warmth(const AirParameters& parameters, double depth_m);

// Greens of the middle distance lose their freshness before air veils them: 0 near … 1 at half as far again as where air begins.
float green_staleness(const AirParameters& parameters, double depth_m);

}  // namespace belvedere
