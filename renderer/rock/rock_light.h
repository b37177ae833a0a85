#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "renderer/paint/light.h"
#include "renderer/paint/rock_kinds.h"
#include "renderer/rock/spurs.h"

namespace belvedere {

// All of one pixel that the light on rock asks for besides its spurs. Noises are of deviation 1.
struct RockPixel {
  glm::vec3 normal{0.0F, 0.0F, 1.0F};  // of the wall: detailed, generalized and smooth, mixed
  float depth_m = 0.0F;
  float slope_deg = 0.0F;
  float shadow = 1.0F;    // 1 lit … 0 in cast shadow, a little blurred
  float sky_view = 1.0F;  // 0…1
  float altitude_m = 0.0F;
  double east_m = 0.0, north_m = 0.0;
  float metres_per_unit = 1.0F;
  float rock = 1.0F;               // share of rock around, 0…1
  float turf = 0.0F, snow = 0.0F;  // shares around, 0…1
  float calm_noise = 0.0F;         // where the hand rests
  float bed_noise = 0.0F;          // of where beds lie …
  float bed_show = 0.0F;           // … and where they are drawn
  float line_noise = 0.0F;
  float cover_noise = 0.0F;
  int band = 0;
  float scale = 1.0F;                         // pixels in a unit: what is smaller than some pixels is left out
  std::optional<GroundLight> own_light = {};  // where light differs from place to place
};

// What a place of rock shows.
struct RockLook {
  float tone = 0.0F;  // 0…1 and a little beyond, as ToneParameters make it
  float turf = 0.0F;  // shares of the paint, 0…1
  float snow = 0.0F;
};

// How a spur's crest or gully stands: -.6 in a gully … +.6 on a crest; both larger sizes.
float stands_out(const SpurHits& hits);

// Light on invented relief: each size turns the wall's normal, and may move the tone only so far, so that big planes carry the picture.
// Beds with their treads, crests and gullies are part of it. `winter`: snow lies on whole flanks, in gullies and along strong beds.
// `sun`: how much of it large spurs let through, 0…1.
RockLook light_rock(const RockKind& kind, const ToneParameters& light, bool winter, const RockPixel& pixel, const SpurHits& hits,
                    float sun = 1.0F);

// Where to look for a large spur that stands in the sun's way: a place beside the pixel's own, units away on the sheet, and the height that
// the ray has gained there, in spacings of large spurs. Nothing (0 and 0) where the wall itself turns away.
struct SunWay {
  glm::vec2 offset{0.0F};
  float gained = 0.0F;
};
SunWay way_to_sun(const RockKind& kind, const ToneParameters& light, const RockPixel& pixel, const SpurHits& hits);
// The share of the sun that passes a spur of that height above the pixel's, both in spacings.
float sun_past(const RockKind& kind, const SunWay& way, float height, float own_height);

}  // namespace belvedere
