#include "renderer/style/fit/class_ramps.h"

#include <algorithm>
#include <cmath>

#include "base/math_exact.h"
#include "base/parallel.h"
#include "base/statistics.h"

namespace belvedere {
namespace {

constexpr double knot_width = 0.05;  // sigma of lightness around a knot
constexpr std::size_t max_class_texels = 20'000;
constexpr int bins = 20;  // of lightness, within which hue is averaged
constexpr double min_chroma = 0.75;

// Gaussian with a sigma of one knot; end values are repeated.
std::array<glm::dvec2, LightLaw::knot_count> smoothed(
    const std::array<glm::dvec2, LightLaw::knot_count>& values) {
  std::array<glm::dvec2, LightLaw::knot_count> out{};
  for (int i = 0; i < LightLaw::knot_count; ++i) {
    glm::dvec2 sum(0.0);
    double weight = 0.0;
    for (int d = -4; d <= 4; ++d) {
      const double w = exact::exp(-0.5 * d * d);
      sum += w * values[static_cast<std::size_t>(std::clamp(i + d, 0, LightLaw::knot_count - 1))];
      weight += w;
    }
    out[static_cast<std::size_t>(i)] = sum / weight;
  }
  return out;
}

struct LightShare {
  double hue_by_light = 0.0;
  double lightness = 0.0;
  std::array<double, 4> quantiles{};
};

std::array<double, 4> weighted_quantiles(std::vector<std::pair<double, double>> values,
                                         double total) {
  std::stable_sort(values.begin(), values.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::array<double, 4> out{};
  std::size_t k = 0;
  double sum = 0.0;
  for (const auto& [value, weight] : values) {
    sum += weight;
    while (k < out.size() && sum >= ramp_quantiles[k] * total) out[k++] = value;
  }
  return out;
}

// Share of the variance of hue that lies between bins of lightness; classes have equal weight.
LightShare light_share(const StylePainting& painting) {
  struct Sum {
    double weight = 0.0;
    glm::dvec2 hue{0.0};
  };
  std::array<Sum, bins> binned;
  std::vector<std::pair<double, double>> lights;  // lightness, weight
  Sum total;
  double squares = 0.0;
  double lightness = 0.0;
  for (const LandCoverClass id : painting.classes) {
    const std::vector<glm::vec3> texels =
        class_texels(painting.soft, painting.clean, id, max_class_texels);
    for (const glm::vec3& texel : texels) {
      const double w = 1.0 / static_cast<double>(texels.size());
      const glm::dvec2 hue(texel.y, texel.z);
      const double light = static_cast<double>(texel.x);
      Sum& bin = binned[static_cast<std::size_t>(std::clamp(light * bins, 0.0, bins - 1.0))];
      bin.weight += w;
      bin.hue += w * hue;
      total.weight += w;
      total.hue += w * hue;
      squares += w * (hue.x * hue.x + hue.y * hue.y);
      lightness += w * light;
      lights.emplace_back(light, w);
    }
  }
  const glm::dvec2 mean = total.hue / total.weight;
  const double variance = squares / total.weight - (mean.x * mean.x + mean.y * mean.y);
  double between = 0.0;
  for (const Sum& bin : binned) {
    if (bin.weight == 0.0) continue;
    const glm::dvec2 off = bin.hue / bin.weight - mean;
    between += bin.weight * (off.x * off.x + off.y * off.y);
  }
  return {std::clamp(between / total.weight / std::max(variance, 1e-9), 0.0, 1.0),
          lightness / total.weight, weighted_quantiles(std::move(lights), total.weight)};
}

}  // namespace

glm::dvec2 LightLaw::at(double lightness) const {
  const double place =
      std::clamp((lightness - first_lightness) / (1.0 - first_lightness), 0.0, 1.0) *
      (knot_count - 1);
  const auto i = std::min(static_cast<std::size_t>(place), hue.size() - 2);
  const double share = place - static_cast<double>(i);
  return hue[i] + share * (hue[i + 1] - hue[i]);
}

double LightLaw::follow() const { return std::clamp(1.2 * hue_by_light, 0.3, 1.0); }
double LightLaw::mix() const { return std::clamp(2.3 * (hue_by_light - 0.25), 0.0, 0.65); }
double LightLaw::by_tone(LandCoverClass id) const {
  const bool bare = id == LandCoverClass::rock || id == LandCoverClass::scree;
  return bare ? std::clamp(10.0 * (hue_by_light - 0.4), 0.0, 1.0) : 0.0;
}

LightLaw law_of(LandCoverClass id, const LightLaw& law) {
  if (id != LandCoverClass::water) return law;
  LightLaw none;
  none.ground_lightness = law.ground_lightness;
  return none;
}

LightLaw fit_light_law(const StylePainting& painting) {
  LightLaw law;
  const LightShare share = light_share(painting);
  law.hue_by_light = share.hue_by_light;
  law.ground_lightness = share.lightness;
  law.tone_lightness = share.quantiles;
  std::array<glm::dvec2, LightLaw::knot_count> means{};
  parallel_rows(LightLaw::knot_count, [&](int i) {
    glm::dvec2 sum(0.0);
    double weight = 0.0;
    for (const glm::vec3& texel : painting.ground) {
      const double off = (static_cast<double>(texel.x) - LightLaw::knot(i)) / knot_width;
      const double w =
          (off * off < 80.0 ? exact::exp(-0.5 * off * off) : 0.0) * (chroma(texel) + 0.005) + 1e-9;
      sum += w * glm::dvec2(texel.y, texel.z);
      weight += w;
    }
    means[static_cast<std::size_t>(i)] = sum / weight;
  });
  law.hue = smoothed(means);
  return law;
}

LabRamp keep_chroma(LabRamp ramp, const LabRamp& before) {
  for (std::size_t k = 0; k < ramp.size(); ++k) {
    const double now = chroma(ramp[k]);
    const double least = min_chroma * chroma(before[k]);
    if (now >= least) continue;
    // Limits the gain of nearly grey colours, whose hue is unreliable.
    const double gain = least / std::max(now, 0.35 * least + 1e-6);
    ramp[k].y *= gain;
    ramp[k].z *= gain;
  }
  return ramp;
}

LabRamp move_lightness(const LabRamp& ramp, const std::array<double, 4>& lightness,
                       const LightLaw& law) {
  LabRamp out = ramp;
  for (std::size_t k = 0; k < ramp.size(); ++k) {
    const glm::dvec2 turn = law.follow() * (law.at(lightness[k]) - law.at(ramp[k].x));
    out[k] = {lightness[k], ramp[k].y + turn.x, ramp[k].z + turn.y};
  }
  return keep_chroma(out, ramp);
}

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
