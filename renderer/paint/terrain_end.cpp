#include "renderer/paint/terrain_end.h"

#include "base/math.h"

namespace belvedere {
namespace {

constexpr float end_air = 0.86F;     // share of air at the end
constexpr double dissolving = 0.38;  // the last strip, as a share of the fade
constexpr float crest_dissolves =
    0.6F;  // factor on dissolving for ground high above its surroundings

// 1 at the edge of the terrain, 0 from `fade_m` inwards.
float rim_share(float rim_m, double fade_m) {
  return 1.0F - smoothstep(static_cast<float>(unit(rim_m / fade_m)));
}

}  // namespace

TerrainEnd terrain_end_at(float rim_m, double fade_m, float raised) {
  return {end_air * rim_share(rim_m, fade_m),
          rim_share(rim_m, dissolving * fade_m) * (1.0F - (1.0F - crest_dissolves) * unit(raised))};
}

}  // namespace belvedere
