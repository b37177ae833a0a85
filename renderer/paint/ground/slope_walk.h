#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "renderer/trace/wide_view.h"

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
// What lies along the walk. Positions are relative to the pixel, so that rounding does not depend
// on the part of the picture.
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

}  // namespace belvedere
