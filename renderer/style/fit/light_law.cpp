#include "renderer/style/fit/light_law.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/math_exact.h"
#include "base/parallel.h"

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

}  // namespace belvedere
