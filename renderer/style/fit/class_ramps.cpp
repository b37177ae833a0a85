#include "renderer/style/fit/class_ramps.h"

#include <algorithm>
#include <cmath>

#include "base/statistics.h"

namespace belvedere {
namespace {

constexpr std::size_t max_ramp_texels = 400'000;

double median_lightness(const std::vector<glm::vec3>& texels) {
  std::vector<float> lightness;
  lightness.reserve(texels.size());
  for (const glm::vec3& texel : texels) lightness.push_back(texel.x);
  return static_cast<double>(middle_value(std::move(lightness)));
}

std::vector<glm::vec3> lighter_texels(std::vector<glm::vec3> texels, double without) {
  std::vector<float> lightness;
  lightness.reserve(texels.size());
  for (const glm::vec3& texel : texels) lightness.push_back(texel.x);
  const float darkest = value_at_share(std::move(lightness), without);
  std::erase_if(texels, [&](const glm::vec3& texel) { return texel.x < darkest; });
  return texels;
}

// Usual light (A3), for classes seen in one light only: moves the lightness of a class relative to
// the ground part of the way to its relative lightness in the reference.
LabRamp usual_light(const LabRamp& ramp, const LabRamp& reference, double reference_ground,
                    double median, LightnessLimits limits, const LightLaw& law,
                    const ClassRampParameters& parameters) {
  const double off = law.ground_lightness + mean_lightness(reference) - reference_ground - median;
  const double move =
      std::copysign(parameters.to_usual * std::max(0.0, std::abs(off) - parameters.own_light), off);
  std::array<double, 4> lightness{};
  for (std::size_t k = 0; k < ramp.size(); ++k)
    lightness[k] = std::clamp(ramp[k].x + move, limits.min, limits.max);
  return move_lightness(ramp, lightness, law);
}

// Maps show water cooler than land. Warm water, under a warm sky, takes most of the hue of the
// coolest paint of its lightness.
bool cool_water(LabRamp& ramp, const std::vector<glm::vec3>& paint,
                const ClassRampParameters& parameters) {
  bool cooled = false;
  for (glm::dvec3& colour : ramp) {
    if (colour.z <= 0.0) continue;
    std::vector<glm::vec3> alike;
    for (const glm::vec3& p : paint)
      if (std::abs(static_cast<double>(p.x) - colour.x) < 0.1) alike.push_back(p);
    const std::size_t coolest = alike.size() / 7;
    if (coolest < 20) continue;
    std::stable_sort(alike.begin(), alike.end(),
                     [](const glm::vec3& a, const glm::vec3& b) { return a.z < b.z; });
    glm::dvec2 sum(0.0);
    for (std::size_t i = 0; i < coolest; ++i) sum += glm::dvec2(alike[i].y, alike[i].z);
    const glm::dvec2 hue = sum / static_cast<double>(coolest);
    if (hue.y >= colour.z) continue;
    colour.y += parameters.to_cool * (hue.x - colour.y);
    colour.z += parameters.to_cool * (hue.y - colour.z);
    cooled = true;
  }
  return cooled;
}

}  // namespace

LabRamp quantile_ramp(std::vector<glm::vec3> texels, const ClassRampParameters& parameters) {
  std::stable_sort(texels.begin(), texels.end(),
                   [](const glm::vec3& a, const glm::vec3& b) { return a.x < b.x; });
  const auto count = static_cast<double>(texels.size());
  LabRamp ramp{};
  for (std::size_t k = 0; k < ramp.size(); ++k) {
    const double q = ramp_quantiles[k];
    const auto begin = static_cast<std::size_t>(std::max(0.0, q - parameters.span) * count);
    const auto end =
        std::clamp(static_cast<std::size_t>(std::min(1.0, q + parameters.span) * count), begin + 1,
                   texels.size());
    glm::dvec3 sum(0.0);
    double weight = 0.0;
    std::vector<double> chromas;
    for (std::size_t i = begin; i < end; ++i) {
      chromas.push_back(chroma(texels[i]) + 1e-4);
      sum += chromas.back() * glm::dvec3(texels[i]);
      weight += chromas.back();
    }
    glm::dvec3 colour = sum / weight;
    const double gain = std::clamp(middle_value(chromas) / std::max(chroma(colour), 1e-3), 1.0,
                                   parameters.strengthen);
    const auto rank = std::min(static_cast<std::size_t>(q * count), texels.size() - 1);
    ramp[k] = {static_cast<double>(texels[rank].x), gain * colour.y, gain * colour.z};
  }
  return ramp;
}

LabRamp stretch_ramp(const LabRamp& ramp, const LabRamp& reference, LightnessLimits limits,
                     const LightLaw& law, const ClassRampParameters& parameters) {
  const double range = ramp[3].x - ramp[0].x;
  const double stretch =
      std::clamp(parameters.min_range * (reference[3].x - reference[0].x) / std::max(range, 1e-3),
                 1.0, parameters.max_stretch);
  const double middle = 0.5 * (ramp[1].x + ramp[2].x);
  LabRamp out = ramp;
  for (glm::dvec3& colour : out) colour.x = middle + stretch * (colour.x - middle);
  // Most of the added range goes into shade; the light end rises only a little.
  const double lightest =
      std::min(limits.max, ramp[3].x + 0.25 * std::max(0.0, 0.5 * (stretch - 1.0) * range) + 0.02);
  const double too_light = std::max(0.0, out[3].x - lightest);
  for (glm::dvec3& colour : out) colour.x -= too_light;
  if (out[0].x < limits.min) {
    out[0].x = limits.min;
    out[1].x = std::max(out[1].x, limits.min + 0.25 * (out[3].x - limits.min));
  }
  for (std::size_t k = 0; k < out.size(); ++k) {
    const glm::dvec2 turn = 0.8 * (law.at(out[k].x) - law.at(ramp[k].x));
    out[k].y += turn.x;
    out[k].z += turn.y;
  }
  return keep_chroma(out, ramp);
}

SeenRamps fit_class_ramps(const StylePainting& painting, const LightLaw& law,
                          const ClassRamps& reference, const ClassRampParameters& parameters) {
  const LightnessLimits limits{painting.min_lightness, painting.max_lightness};
  const double reference_ground = ground_lightness(reference);
  SeenRamps out;
  for (const LandCoverClass id : painting.classes) {
    const std::size_t c = index_of(id);
    std::vector<glm::vec3> texels =
        class_texels(painting.soft, painting.clean, id, max_ramp_texels);
    if (id == LandCoverClass::snow)
      texels = lighter_texels(std::move(texels), parameters.darkest_snow);
    const double median = median_lightness(texels);
    const LightLaw own = law_of(id, law);
    LabRamp ramp = usual_light(quantile_ramp(std::move(texels), parameters), reference[c],
                               reference_ground, median, limits, own, parameters);
    // Remove hue that depends on lightness alone (A2).
    const double by_tone = own.by_tone(id);
    const double mix = std::lerp(own.mix(), 1.0, by_tone);
    for (std::size_t k = 0; k < ramp.size(); ++k) {
      const glm::dvec2 hue = own.at(std::lerp(ramp[k].x, own.tone_lightness[k], by_tone));
      ramp[k].y += mix * (hue.x - ramp[k].y);
      ramp[k].z += mix * (hue.y - ramp[k].z);
    }
    ramp = stretch_ramp(ramp, reference[c], limits, own, parameters);
    if (id == LandCoverClass::water && cool_water(ramp, painting.every, parameters))
      out.notes.emplace_back("water is warm: moved towards the coolest paint of its lightness");
    out.ramps[c] = ramp;
    out.seen[c] = true;
  }
  return out;
}

}  // namespace belvedere
