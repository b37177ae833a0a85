#include "renderer/paint/terrain_end.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "base/math.h"

namespace belvedere {
namespace {

constexpr float end_air = 0.86F;     // share of air at the end
constexpr double dissolving = 0.38;  // the last strip, as a share of the fade
constexpr float crest_dissolves =
    0.6F;  // factor on dissolving for ground high above its surroundings

constexpr double side_units = 150.0;    // over which the side of the terrain fades …
constexpr double side_of_sheet = 0.11;  // … but no more than this share of the sheet's width
constexpr double seen_units = 40.0;     // a cut so far outside the picture is not faded …
// Cosine of the angle between line of sight and edge from which a cut stands upright, and full.
constexpr double upright_from = 0.55;
constexpr double upright_full = 0.88;
constexpr float ragged = 0.11F;  // of the fade

// 1 at the edge of the terrain, 0 from `fade_m` inwards.
float rim_share(float rim_m, double fade_m) {
  return 1.0F - smoothstep(static_cast<float>(unit(rim_m / fade_m)));
}

}  // namespace

TerrainEnd terrain_end_at(float rim_m, double fade_m, float raised) {
  return {end_air * rim_share(rim_m, fade_m),
          rim_share(rim_m, dissolving * fade_m) * (1.0F - (1.0F - crest_dissolves) * unit(raised))};
}

float side_share(const TerrainSides& sides, const SidePlace& place) {
  const glm::dvec2 sight = place.position - sides.viewer;
  const double away = glm::length(sight);
  if (!(away > 0.0) || !(place.metres_per_unit > 0.0)) return 0.0F;
  const glm::dvec2 ahead = sight / away;
  const glm::dvec2 right(ahead.y, -ahead.x);
  double share = 0.0;
  for (const double side : {-1.0, 1.0}) {
    const glm::dvec2 aside = side * right;
    // The nearest edge on this side, and the cosine between it and the line of sight.
    double distance_m = std::numeric_limits<double>::infinity();
    double along = 0.0;
    for (const int axis : {0, 1}) {
      if (aside[axis] == 0.0) continue;
      const double edge = aside[axis] > 0.0 ? sides.high[axis] : sides.low[axis];
      const double way_m = std::max(0.0, (edge - place.position[axis]) / aside[axis]);
      if (way_m >= distance_m) continue;
      distance_m = way_m;
      along = std::abs(ahead[1 - axis]);
    }
    const double distance = distance_m / place.metres_per_unit;
    const double from_border = side < 0.0
                                   ? place.from_left_units - distance
                                   : place.sheet_width_units - place.from_left_units - distance;
    const double width_units = std::min(side_units, side_of_sheet * place.sheet_width_units) *
                               smoothstep(upright_from, upright_full, along) *
                               smoothstep(-seen_units, 0.0, from_border);
    if (width_units > 0.0) share = std::max(share, unit(1.0 - distance / width_units));
  }
  return static_cast<float>(share);
}

TerrainEnd with_sides(TerrainEnd end, float side, float noise) {
  if (side <= 0.0F) return end;
  const float in = 1.0F - side + ragged * std::clamp(noise, -1.5F, 1.5F) * side;
  return {std::max(end.air, end_air * (1.0F - smoothstep(0.15F, 1.0F, in))),
          std::max(end.dissolved, 1.0F - smoothstep(0.16F, 0.72F, in))};
}

}  // namespace belvedere
