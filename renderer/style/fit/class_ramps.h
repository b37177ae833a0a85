#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "renderer/style/fit/light_law.h"
#include "renderer/style/fit/style_colours.h"
#include "renderer/style/fit/style_painting.h"

namespace belvedere {

struct ClassRampParameters {
  // Of lightness within a class: where ramp_tones lie in the program's pictures.
  std::array<double, 4> quantiles = {0.03, 0.19, 0.54, 0.97};
  double span = 0.10;          // of rank, whose hues a colour is the mean of, each way
  double strengthen = 1.15;    // of a mean's chroma, at most, toward the median chroma
  double darkest_snow = 0.25;  // share of snow that is left out: rock shines through it
  double own_light = 0.04;     // how far a class may be from its usual lightness among the others,
  double to_usual = 0.6;       // and the share of the way beyond it that it is moved
  double min_range = 0.85;     // of the reference's range of lightness, that a ramp must have
  double max_stretch = 2.6;
};

struct SeenRamps {
  ClassRamps ramps{};
  ClassFlags seen{};
};

// The ramp of the colours of a class (recipe A1): lightness at the quantiles, hue by means weighted
// with chroma, which is the colour the eye takes away; medians are mud. At least one colour.
LabRamp quantile_ramp(std::vector<glm::vec3> texels, const ClassRampParameters& parameters = {});

struct LightnessLimits {
  double min;
  double max;
};
// Light and shade must carry form (A4): at least `min_range` of the reference's range of lightness,
// inside the painting's own. What is added takes its hue from the law of light.
LabRamp stretch_ramp(const LabRamp& ramp, const LabRamp& reference, LightnessLimits limits,
                     const LightLaw& law, const ClassRampParameters& parameters = {});

// The ramps of the classes that the painting shows (A1, A3, A4).
SeenRamps fit_class_ramps(const StylePainting& painting, const LightLaw& law,
                          const ClassRamps& reference, const ClassRampParameters& parameters = {});

}  // namespace belvedere
