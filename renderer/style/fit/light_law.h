#pragma once

#include <array>
#include <glm/vec2.hpp>

#include "renderer/style/fit/style_colours.h"
#include "renderer/style/fit/style_painting.h"

namespace belvedere {

// How hue goes with light in a painting (recipe A2): hue that belongs to light must not be given to
// a class.
struct LightLaw {
  static constexpr int knot_count = 21;
  static constexpr double first_lightness = 0.05;  // the last is 1

  std::array<glm::dvec2, knot_count> hue{};  // mean (a, b) of all ground of that lightness
  double hue_by_light = 0.0;      // η: share of the hue's variance that lightness alone explains
  double ground_lightness = 0.0;  // mean L of the ground, classes counting alike

  static double knot(int i) {
    return first_lightness + (1.0 - first_lightness) * i / (knot_count - 1);
  }
  glm::dvec2 at(double lightness) const;  // linear between knots, constant beyond
  // How far hue follows when lightness is changed, and how far classes give up their own hue:
  // clip(1.2 η, .3, 1) and clip(2.3 (η - .25), 0, .65).
  double follow() const;
  double mix() const;
};

LightLaw fit_light_law(const StylePainting& painting);

// The ramp at other lightnesses; hue goes the way it goes in the painting where that grows lighter
// or darker, never under 75 % of its chroma before.
LabRamp move_lightness(const LabRamp& ramp, const std::array<double, 4>& lightness,
                       const LightLaw& law);
// On the way from one hue to another a colour does not fall into grey: at least 75 % of the chroma
// it had.
LabRamp keep_chroma(LabRamp ramp, const LabRamp& before);

}  // namespace belvedere
