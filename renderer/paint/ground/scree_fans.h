#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "renderer/trace/wide_view.h"

namespace belvedere {

// Loose stone as a painter sees it: fans that are fresh and grey where they leave the walls, pale in the middle, and grow green towards
// their feet, drawn out in streaks by what runs down them.
struct ScreeFans {
  Grid<float> place;   // 0 below the wall … 1 at the foot; of scree pixels
  Grid<float> streak;  // noise of deviation about 1, long down the fall line
};
struct ScreeFanParameters {
  double pixels_per_unit = 1.0;  // a unit is 0.5 mm of the sheet
  std::uint64_t seed = 1;
};

// Needs depths, classes and fall lines. Local up to scree_fans_margin_px(); it is the wide view that must reach so far. Pixels outside
// `wanted` (empty: all) hold 0.
ScreeFans make_scree_fans(const GuidanceBuffers& guidance, const WideView& wide, const ScreeFanParameters& parameters, glm::ivec2 origin_px,
                          PixelRect wanted = {});
int scree_fans_margin_px(double pixels_per_unit);

// What a place on a fan does to the paint of its stone.
struct ScreeTurn {
  float tone = 0.0F;       // added to the light
  glm::vec3 factor{1.0F};  // of the colour, encoded sRGB
  float grown = 0.0F;      // share of grass, 0…1
};
// relief_s_m: height above the ground around. strength 0…3: AirParameters::hue_drift.
ScreeTurn scree_turn(float place, float streak, float relief_s_m, float strength);

}  // namespace belvedere
