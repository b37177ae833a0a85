#include "renderer/world/season/palette_season.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <set>
#include <utility>
#include <vector>

namespace belvedere {
namespace {

constexpr double step_m = 50.0;

ToneRamp ramp_at(const Palette& palette, LandCoverClass id, double altitude_m) {
  ToneRamp ramp;
  for (std::size_t k = 0; k < ramp.size(); ++k)
    ramp[k] = palette_colour(palette, id, altitude_m, ramp_tones[k]);
  return ramp;
}

// The sky's colour between its stops.
glm::vec3 sky_at(const Palette& palette, double at) {
  const auto& stops = palette.sky;
  const auto after =
      std::find_if(stops.begin(), stops.end(), [&](const auto& stop) { return stop.first >= at; });
  if (after == stops.begin()) return stops.front().second;
  if (after == stops.end()) return stops.back().second;
  const auto& [low, colour] = *(after - 1);
  return glm::mix(colour, after->second, static_cast<float>((at - low) / (after->first - low)));
}

}  // namespace

Palette palette_at_other_altitudes(Palette palette, double higher_m) {
  for (ClassPalette& ramps : palette.classes)
    if (ramps.stops.size() > 1)
      for (ClassPalette::Stop& stop : ramps.stops) stop.altitude_m += higher_m;
  palette.treeline_m += higher_m;
  return palette;
}

Palette mix_palettes(const Palette& first, const Palette& second,
                     const std::function<double(double altitude_m)>& share, double lowest_m,
                     double highest_m) {
  Palette mixed = first;
  for (std::size_t c = 0; c < land_cover_class_count; ++c) {
    const auto id = static_cast<LandCoverClass>(c);
    if (id == LandCoverClass::sky || first.classes[c].stops.empty()) continue;
    std::set<double> altitudes;
    for (const Palette* palette : {&first, &second})
      for (const ClassPalette::Stop& stop : palette->classes[c].stops)
        altitudes.insert(stop.altitude_m);
    for (double at = std::floor(lowest_m / step_m) * step_m; at <= highest_m + step_m; at += step_m)
      if (share(at - step_m) != share(at) || share(at) != share(at + step_m)) altitudes.insert(at);
    mixed.classes[c].stops.clear();
    for (const double altitude : altitudes) {
      const auto of_second = static_cast<float>(share(altitude));
      const ToneRamp a = ramp_at(first, id, altitude);
      const ToneRamp b = ramp_at(second, id, altitude);
      ToneRamp ramp;
      for (std::size_t k = 0; k < ramp.size(); ++k) ramp[k] = glm::mix(a[k], b[k], of_second);
      mixed.classes[c].stops.push_back({altitude, ramp});
    }
  }
  const double mean = 0.5 * (share(lowest_m) + share(highest_m));
  const auto part = static_cast<float>(mean);
  for (auto& [at, colour] : mixed.sky) colour = glm::mix(colour, sky_at(second, at), part);
  for (glm::vec3 Palette::*colour : {&Palette::cloud_light, &Palette::cloud_shade,
                                     &Palette::haze_near, &Palette::haze_far, &Palette::range_mist})
    mixed.*colour = glm::mix(first.*colour, second.*colour, part);
  for (double Palette::*strength :
       {&Palette::haze_share, &Palette::warm_share, &Palette::ground_drift_share,
        &Palette::forest_drift_share, &Palette::rock_drift_share})
    mixed.*strength = std::lerp(first.*strength, second.*strength, mean);
  // Trees turn one after the other: a share of them has the other palette's leaves.
  mixed.growth.leaf_share = std::lerp(first.growth.leaf_share, second.growth.leaf_share, mean);
  mixed.growth.larch = glm::mix(first.growth.larch, second.growth.larch, part);
  mixed.growth.larch_share = std::lerp(first.growth.larch_share, second.growth.larch_share, mean);
  const std::size_t leaves = std::min(first.growth.leaves.size(), second.growth.leaves.size());
  for (std::size_t k = 0; k < leaves; ++k)
    mixed.growth.leaves[k] = glm::mix(first.growth.leaves[k], second.growth.leaves[k], part);
  return mixed;
}

}  // namespace belvedere
