#pragma once

#include "base/progress.h"
#include "renderer/rock/rock_relief.h"

namespace belvedere {

// Open ground seen from near (close_share): forms that elevation data do not contain, lit by
// a sun that is turned until it rakes, as Imhof turned his local light: a slope that faces the sun
// has no modelling of its own. Snow lies in low roofs, down the fall line where it is steep and
// along the wind where it is not; scree and grass have broader, lower ones. Borders between open
// classes follow a small relief, so that tongues point down and gullies fill.

// Adds to a relief of rock, where the ground is close and not rock: the class as borders show it,
// the number of each form's plane, and in `tone` what the forms add to the light. Reads the
// channels of rock; `wanted` and reach as make_rock_relief, within close_near_margin_px of the
// window and close_margin_px of the wide view.
void add_close_relief(RockRelief& relief, const GuidanceBuffers& guidance, const WideView& wide,
                      const RockParameters& parameters, glm::ivec2 origin_px, Progress& progress,
                      PixelRect wanted = {});
int close_near_margin_px(const RockParameters& parameters);
int close_margin_px(const RockParameters& parameters);

}  // namespace belvedere
