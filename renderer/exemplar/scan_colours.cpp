#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/common.hpp>

#include "base/land_cover_class.h"
#include "renderer/exemplar/scan.h"
#include "renderer/image/srgb.h"

// Palettes with the colours of paintings: take_colours() of scan.h.

namespace belvedere {
namespace {

// A painting's own light is often too faint to show relief, and much of it is in strokes, which
// ramps leave out. The ramp gets at least this share of the palette's range of lightness (OKLab),
// about its centre, with hue and saturation kept; stretched at most threefold.
constexpr double min_range_share = 0.8;
constexpr double largest_stretch = 3.0;
ToneRamp stretch(const ToneRamp& ramp, const ToneRamp& target) {
  const auto range = [](const ToneRamp& r) { return to_oklab(r.back()).x - to_oklab(r.front()).x; };
  const double factor = std::clamp(min_range_share * range(target) / std::max(range(ramp), 1e-3),
                                   1.0, largest_stretch);
  double centre = 0.0;
  for (const glm::vec3& colour : ramp)
    centre += to_oklab(colour).x / static_cast<double>(ramp.size());
  ToneRamp out = ramp;
  for (glm::vec3& colour : out) {
    glm::dvec3 lab = to_oklab(colour);
    lab.x = std::clamp(centre + factor * (lab.x - centre), 0.0, 1.0);
    colour = glm::clamp(from_oklab(lab), 0.F, 1.F);
  }
  return out;
}

glm::vec3 gradient_at(const std::vector<std::pair<double, glm::vec3>>& gradient, double position) {
  for (std::size_t k = 1; k < gradient.size(); ++k)
    if (position <= gradient[k].first) {
      const double width = gradient[k].first - gradient[k - 1].first;
      const double share = std::clamp((position - gradient[k - 1].first) / width, 0.0, 1.0);
      return glm::mix(gradient[k - 1].second, gradient[k].second, static_cast<float>(share));
    }
  return gradient.back().second;
}

}  // namespace

Palette take_colours(const Palette& palette, const std::vector<ScannedPainting>& scans,
                     const std::vector<std::pair<LandCoverClass, LandCoverClass>>& fallback) {
  Palette out = palette;
  constexpr double usual_altitude_m =
      1500.0;  // altitude at which palettes that change with altitude are compared
  std::array<bool, land_cover_class_count> known{};
  // Nearest distance: the scene sets the effect of air on it.
  for (std::size_t id = 1; id < known.size(); ++id) {
    ToneRamp sum{};
    float texels = 0.F;
    for (const ScannedPainting& scan : scans) {
      const LabelRamps& fitted = scan.ramps[id];
      if (fitted.ramps.empty()) continue;
      const auto count = static_cast<float>(fitted.texels);
      for (std::size_t t = 0; t < sum.size(); ++t) sum[t] += count * fitted.ramps.front()[t];
      texels += count;
    }
    if (!(texels > 0.F)) continue;
    known[id] = true;
    for (glm::vec3& colour : sum) colour /= texels;
    ToneRamp own{};
    for (std::size_t t = 0; t < own.size(); ++t)
      own[t] =
          palette_colour(palette, static_cast<LandCoverClass>(id), usual_altitude_m, ramp_tones[t]);
    out.classes[id].stops = {{0.0, stretch(sum, own)}};
  }
  const int classes = static_cast<int>(std::count(known.begin(), known.end(), true));
  if (classes == 0) return palette;
  ToneRamp shift{};
  for (std::size_t id = 1; id < known.size(); ++id)
    for (std::size_t t = 0; t < shift.size() && known[id]; ++t)
      shift[t] += (out.classes[id].stops.front().ramp[t] -
                   palette_colour(palette, static_cast<LandCoverClass>(id), usual_altitude_m,
                                  ramp_tones[t])) /
                  static_cast<float>(classes);
  for (std::size_t id = 1; id < known.size(); ++id) {
    if (known[id]) continue;
    const auto stand_in = std::find_if(fallback.begin(), fallback.end(), [&](const auto& pair) {
      return pair.first == static_cast<LandCoverClass>(id);
    });
    if (stand_in != fallback.end() && known[static_cast<std::size_t>(stand_in->second)]) {
      out.classes[id].stops = out.classes[static_cast<std::size_t>(stand_in->second)].stops;
      continue;
    }
    for (ClassPalette::Stop& stop : out.classes[id].stops)
      for (std::size_t t = 0; t < shift.size(); ++t)
        stop.ramp[t] = glm::clamp(stop.ramp[t] + shift[t], 0.F, 1.F);
  }
  for (const ScannedPainting& scan : scans) {
    if (scan.sky.empty()) continue;
    out.sky = scan.sky;
    out.cloud_light = scan.cloud_light;
    out.cloud_shade = scan.cloud_shade;
    // Air has the sky's blue where it begins and the horizon's colour far away.
    out.haze_near = gradient_at(scan.sky, 0.35);
    out.haze_far = gradient_at(scan.sky, 0.8);
    out.range_mist = gradient_at(scan.sky, 0.85);
    break;
  }
  return out;
}

}  // namespace belvedere
