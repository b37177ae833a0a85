#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "base/guidance_buffers.h"
#include "base/pixel_rect.h"
#include "renderer/trace/camera.h"

namespace belvedere {

// A walk along the fall line over ground of one class, on one surface.

// Where a walk begins: a pixel of the sheet and its values.
struct SlopeStart {
  glm::ivec2 sheet_px;
  glm::vec2 fall;  // unit, in the image; 0: level
  float depth_m;
};
struct SlopeSteps {
  float step_px;    // of the sheet
  float sign;       // 1 down, -1 up
  int steps;        // maximum
  int noise_steps;  // the noise is summed over this many
};
// Result of a walk. Positions are relative to the pixel, so that rounding does not depend on the
// part of the picture.
struct SlopeWalk {
  float noise_sum = 0.0F;   // without the pixel itself
  float left_after = 0.0F;  // steps after which the class ended, to 1/16 of a step; 0: it did not
  std::size_t end = 0;      // a wide pixel beyond, close to where the class ended, …
  glm::vec2 end_px{0.0F};   // … and its offset from the walk's first pixel, px of the sheet
};

// `noise`: per wide pixel.
SlopeWalk walk_slope(const WideView& wide, const Grid<float>& noise, const SlopeStart& start,
                     LandCoverClass over, const SlopeSteps& way);
// The position where a walk left its class, m from the guidance's origin. It is interpolated
// between the centres of wide pixels, so that neighbouring walks show no steps.
glm::vec3 place_left(const WideView& wide, const SlopeStart& start, const SlopeWalk& walk);

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
