#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "renderer/style/fit/light_law.h"
#include "renderer/style/fit/style_painting.h"

namespace belvedere {

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
