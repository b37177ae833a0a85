#pragma once

#include "renderer/style/fit/light_law.h"
#include "renderer/style/fit/style_colours.h"

namespace belvedere {

struct LightenedRamps {
  ClassRamps ramps{};
  double power = 1.0;  // of lightness: 1 where nothing was done
};

// Dark paintings are lightened as by cleaning their varnish (recipe A6): all ramps by one power of
// lightness, the lightest end kept, until the ground of a usual panorama has the mean lightness
// `goal` (or the power .45).
LightenedRamps lighten_ramps(const ClassRamps& ramps, double goal, double max_lightness,
                             const LightLaw& law);

}  // namespace belvedere
