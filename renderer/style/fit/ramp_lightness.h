#pragma once

#include "renderer/style/fit/light_law.h"
#include "renderer/style/fit/style_colours.h"

namespace belvedere {

struct LightenedRamps {
  ClassRamps ramps{};
  double power = 1.0;  // of lightness: 1 where nothing was done
};

// Lightens the ramps of dark paintings, as if their varnish were cleaned (recipe A6): one power of
// lightness for all ramps, with max_lightness unchanged, until the ground of a typical panorama has
// the mean lightness `goal` (or the power is .45).
LightenedRamps lighten_ramps(const ClassRamps& ramps, double goal, double max_lightness,
                             const LightLaw& law);

}  // namespace belvedere
