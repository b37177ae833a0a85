#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "renderer/paint/light.h"
#include "renderer/paint/rock_kinds.h"
#include "renderer/rock/spurs.h"

namespace belvedere {

// The inputs of one pixel for the light on rock, besides its spurs. Noises have deviation 1.
struct RockPixel {
  glm::vec3 normal{0.0F, 0.0F, 1.0F};  // of the wall: detailed, generalized and smooth, mixed
  float depth_m = 0.0F;
  float slope_deg = 0.0F;
  float shadow = 1.0F;    // 1 lit … 0 in cast shadow, slightly blurred
  float sky_view = 1.0F;  // 0…1
  float altitude_m = 0.0F;
  double east_m = 0.0, north_m = 0.0;
  float metres_per_unit = 1.0F;
  float rock = 1.0F;               // share of rock around, 0…1
  float turf = 0.0F, snow = 0.0F;  // shares around, 0…1
  float calm_noise = 0.0F;         // where brushwork is sparse
  float bed_noise = 0.0F;          // position of beds …
  float bed_show = 0.0F;           // … and where they are drawn
  float line_noise = 0.0F;
  float cover_noise = 0.0F;
  float wall_noise = 0.0F;  // which whole walls are bare
  int band = 0;
  float scale = 1.0F;  // pixels in a unit: forms of a few pixels are left out
  std::optional<GroundLight> own_light = {};  // where light varies with position
};

// The look of a position on rock.
struct RockLook {
  float tone = 0.0F;  // 0…1 and slightly beyond, as ToneParameters make it
  float turf = 0.0F;  // shares of the paint, 0…1
  float snow = 0.0F;
};

// Position between a spur's gully and crest: -.6 in a gully … +.6 on a crest; both larger sizes.
float stands_out(const SpurHits& hits);

// Light on synthetic relief: each size turns the wall's normal and may change the tone by a limited
// amount, so that large planes dominate. Includes beds with their treads, crests and gullies.
// `winter`: snow lies on whole flanks, in gullies and along strong beds. `sun`: share of sunlight
// that passes large spurs, 0…1.
RockLook light_rock(const RockKind& kind, const ToneParameters& light, bool winter,
                    const RockPixel& pixel, const SpurHits& hits, float sun = 1.0F);

// Where to look for a large spur between a pixel and the sun: a position next to the pixel, units
// away on the sheet, and the height that the ray has gained there, in spacings of large spurs. 0
// and 0 where the wall itself faces away.
struct SunPath {
  glm::vec2 offset{0.0F};
  float gained = 0.0F;
};
SunPath way_to_sun(const RockKind& kind, const ToneParameters& light, const RockPixel& pixel,
                   const SpurHits& hits);
// The share of sunlight that passes a spur of that height above the pixel's, both in spacings. Near
// (`close`: close_share) the edge of a broad shadow is soft.
float sun_past(const RockKind& kind, const SunPath& way, float height, float own_height,
               float close = 0.0F);

}  // namespace belvedere
