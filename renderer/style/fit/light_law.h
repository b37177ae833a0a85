#pragma once

#include <array>
#include <glm/vec2.hpp>

#include "renderer/style/fit/style_colours.h"
#include "renderer/style/fit/style_painting.h"

namespace belvedere {

// Dependence of hue on lightness in a painting (recipe A2), so that hue due to light is not
// ascribed to a class.
struct LightLaw {
  static constexpr int knot_count = 21;
  static constexpr double first_lightness = 0.05;  // the last is 1

  std::array<glm::dvec2, knot_count> hue{};  // mean (a, b) of all ground of that lightness
  double hue_by_light = 0.0;      // η: share of the hue's variance that lightness alone explains
  double ground_lightness = 0.0;  // mean L of the ground, classes weighted equally

  static double knot(int i) {
    return first_lightness + (1.0 - first_lightness) * i / (knot_count - 1);
  }
  glm::dvec2 at(double lightness) const;  // linear between knots, constant beyond
  // Share by which hue follows a change of lightness, and share by which the hue of classes is
  // replaced by that of the law: clip(1.2 η, .3, 1) and clip(2.3 (η - .25), 0, .65).
  double follow() const;
  double mix() const;
};

LightLaw fit_light_law(const StylePainting& painting);

// The ramp with other lightnesses. Hue follows the law of light; chroma keeps at least 75 %.
LabRamp move_lightness(const LabRamp& ramp, const std::array<double, 4>& lightness,
                       const LightLaw& law);
// Raises chroma to at least 75 % of `before`: colours between two hues would otherwise turn grey.
LabRamp keep_chroma(LabRamp ramp, const LabRamp& before);

}  // namespace belvedere
