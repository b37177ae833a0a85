#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "renderer/trace/wide_view.h"

namespace belvedere {

// Fans of loose stone as a painter shows them: fresh and grey below the walls, pale in the centre,
// greener towards their feet, with streaks down the slope.
struct ScreeFans {
  Grid<float> position;  // 0 below the wall … 1 at the foot; of scree pixels
  Grid<float> streak;    // noise of deviation about 1, long down the fall line
};
struct ScreeFanParameters {
  double pixels_per_unit = 1.0;  // a unit is 0.5 mm of the sheet
  std::uint64_t seed = 1;
};

// Needs depths, classes and fall lines. Local up to scree_fans_margin_px(); only the wide view must
// reach so far. Pixels outside `wanted` (empty: all) hold 0.
ScreeFans make_scree_fans(const GuidanceBuffers& guidance, const WideView& wide,
                          const ScreeFanParameters& parameters, glm::ivec2 origin_px,
                          PixelRect wanted = {});
int scree_fans_margin_px(double pixels_per_unit);

// How a position on a fan changes the paint of its stone.
struct ScreeTurn {
  float tone = 0.0F;       // added to the light
  glm::vec3 factor{1.0F};  // of the colour, encoded sRGB
  float grown = 0.0F;      // share of grass, 0…1
};
// relief_s_m: height above the ground around. strength 0…3: AirParameters::hue_drift.
ScreeTurn scree_turn(float position, float streak, float relief_s_m, float strength);

// Colour of near debris: fresh in cones (renderer/close), old and weathered between them. `close`:
// as close_share.
glm::vec3 near_scree_hue(bool in_cone, float close);

}  // namespace belvedere
