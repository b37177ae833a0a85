#include "renderer/style/fit/style_colours.h"

#include <algorithm>
#include <glm/common.hpp>

#include "base/math_exact.h"
#include "renderer/image/oklab.h"

namespace belvedere {

double chroma(const glm::dvec3& lab) { return exact::hypot(lab.y, lab.z); }

double mean_lightness(const LabRamp& ramp) {
  double sum = 0.0;
  for (std::size_t k = 0; k < ramp.size(); ++k) sum += tone_shares[k] * ramp[k].x;
  return sum;
}

double ground_lightness(const ClassRamps& ramps) {
  double sum = 0.0;
  for (std::size_t c = 0; c < ramps.size(); ++c)
    if (area_shares[c] > 0.0) sum += area_shares[c] * mean_lightness(ramps[c]);
  return sum;
}

ToneRamp encoded_ramp(const LabRamp& ramp) {
  ToneRamp out{};
  for (std::size_t k = 0; k < ramp.size(); ++k)
    out[k] = glm::clamp(from_oklab(ramp[k]), 0.0F, 1.0F);
  return out;
}

ClassRamps palette_ramps(const Palette& palette) {
  ClassRamps ramps{};
  for (std::size_t c = 1; c < ramps.size(); ++c) {
    const std::vector<ClassPalette::Stop>& stops = palette.classes[c].stops;
    if (stops.empty()) continue;
    for (std::size_t k = 0; k < ramp_tones.size(); ++k)
      ramps[c][k] = to_oklab(stops[stops.size() / 2].ramp[k]);
  }
  return ramps;
}

std::string class_words(LandCoverClass id) {
  std::string words(class_name(id));
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

}  // namespace belvedere
