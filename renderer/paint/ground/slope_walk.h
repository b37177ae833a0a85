#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "renderer/trace/wide_view.h"

namespace belvedere {

// A walk along the fall line over ground of one class, as far as it reaches on one surface.

// Where a walk begins: a pixel of the sheet, and what is known of it.
struct SlopeStart {
  glm::ivec2 sheet_px;
  glm::vec2 fall;  // unit, in the image; 0: level
  float depth_m;
};
struct SlopeSteps {
  float step_px;    // of the sheet
  float sign;       // 1 down, -1 up
  int steps;        // at most
  int noise_steps;  // over so many the noise is summed
};
// What lies along it. Places are relative to the pixel, so that rounding does not depend on the part of the picture.
struct SlopeWalk {
  float noise_sum = 0.0F;   // without the pixel itself
  float left_after = 0.0F;  // steps after which the class ended, to a sixteenth of one; 0: it did not
  std::size_t end = 0;      // a wide pixel beyond, close to where it ended, …
  glm::vec2 end_px{0.0F};   // … which is so far from the pixel where the walk began, px of the sheet
};

// `noise`: of wide pixels.
SlopeWalk walk_slope(const WideView& wide, const Grid<float>& noise, const SlopeStart& start, LandCoverClass over, const SlopeSteps& way);
// The place where a walk left its class, m from the guidance's origin: between the middles of wide pixels, so that neighbours which leave
// it at neighbouring places have no stairs of wide pixels between them.
glm::vec3 place_left(const WideView& wide, const SlopeStart& start, const SlopeWalk& walk);

}  // namespace belvedere
