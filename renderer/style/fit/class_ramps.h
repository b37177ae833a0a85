#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "renderer/style/fit/style_painting.h"

namespace belvedere {

// Dependence of hue on lightness in a painting (recipe A2), so that hue due to light is not
// ascribed to a class.
struct LightLaw {
  static constexpr int knot_count = 21;
  static constexpr double first_lightness = 0.05;  // the last is 1

  std::array<glm::dvec2, knot_count> hue{};  // mean (a, b) of all ground of that lightness
  double hue_by_light = 0.0;  // η: share of the hue's variance that lightness alone explains
  // L of the ground, classes weighted equally: mean, and quantiles at ramp_quantiles.
  double ground_lightness = 0.0;
  std::array<double, 4> tone_lightness{};

  static double knot(int i) {
    return first_lightness + (1.0 - first_lightness) * i / (knot_count - 1);
  }
  glm::dvec2 at(double lightness) const;  // linear between knots, constant beyond
  // Share by which hue follows a change of lightness: clip(1.2 η, .3, 1).
  double follow() const;
  // Share by which the hue of a class is replaced by that of the law: clip(2.3 (η - .25), 0, .65).
  double mix() const;
  // Share by which the hue of bare ground depends on its tone alone, 0 up to η = .4, 1 from .5:
  // painters of light give rock no hue of its own, and may show all of it in shade.
  double by_tone(LandCoverClass id) const;
};

// The law that holds for a class: none for water, which reflects the sky.
LightLaw law_of(LandCoverClass id, const LightLaw& law);

LightLaw fit_light_law(const StylePainting& painting);

// The ramp with other lightnesses. Hue follows the law of light; chroma keeps at least 75 %.
LabRamp move_lightness(const LabRamp& ramp, const std::array<double, 4>& lightness,
                       const LightLaw& law);
// Raises chroma to at least 75 % of `before`: colours between two hues would otherwise turn grey.
LabRamp keep_chroma(LabRamp ramp, const LabRamp& before);

struct ClassRampParameters {
  double span = 0.10;          // hues are averaged over ranks within ± this share
  double strengthen = 1.15;    // max gain of a mean's chroma, towards the median chroma
  double darkest_snow = 0.25;  // share of snow that is ignored: rock shows through
  double own_light = 0.04;     // tolerated difference from the usual relative lightness,
  double to_usual = 0.6;       // and the share of the excess by which a class is moved
  double min_range = 0.85;     // min share of the reference's range of lightness
  double max_stretch = 2.6;
  double to_cool = 0.7;  // share by which warm water is moved to cool hues
};

struct SeenRamps {
  ClassRamps ramps{};
  ClassFlags seen{};
  std::vector<std::string> notes;  // what is not as in the painting
};

// The ramp of a class from its colours (recipe A1): lightness at the quantiles, hue as a mean
// weighted with chroma, because medians of mixed hues are nearly grey. Needs at least one colour.
LabRamp quantile_ramp(std::vector<glm::vec3> texels, const ClassRampParameters& parameters = {});

struct LightnessLimits {
  double min;
  double max;
};
// Stretches a ramp to at least `min_range` of the reference's range of lightness, within the
// limits, so that light and shade show form (A4). Added range takes its hue from the law of light.
LabRamp stretch_ramp(const LabRamp& ramp, const LabRamp& reference, LightnessLimits limits,
                     const LightLaw& law, const ClassRampParameters& parameters = {});

// The ramps of the classes that the painting shows (A1, A3, A4).
SeenRamps fit_class_ramps(const StylePainting& painting, const LightLaw& law,
                          const ClassRamps& reference, const ClassRampParameters& parameters = {});

}  // namespace belvedere
