#include "renderer/world/scene_season.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <limits>
#include <set>
#include <string>

#include "base/error.h"
#include "base/math.h"
#include "terrain/climate/default_climate.h"
#include "terrain/climate/water_balance.h"
#include "terrain/cover/class_rules.h"

namespace belvedere {

bool names_climate(const Scene& scene) {
  SceneClimate climate = scene.climate;
  climate.clearings = 0.0;  // anywhere
  return climate != SceneClimate{};
}

bool knows_place(const Scene& scene, const Dem& dem) {
  return !dem.crs.empty() || scene.climate.latitude_deg.has_value();
}

void require_place(const Scene& scene, const Dem& dem) {
  if (!knows_place(scene, dem))
    throw Error(ErrorKind::usage, "climate.latitude_deg",
                "a terrain without coordinate system has no known latitude",
                "its latitude, -90 … 90");
}

Climate make_scene_climate(const LoadedScene& loaded, const Dem& dem, Progress& progress) {
  const SceneClimate& settings = loaded.scene.climate;
  require_place(loaded.scene, dem);
  const auto raster = [&](const std::string& file) -> std::optional<RasterSource> {
    if (file.empty()) return {};
    RasterSource source;
    source.path = find_scene_file(loaded, file);
    return source;
  };
  ClimateParameters parameters;
  if (!settings.stations.empty()) parameters.stations = find_scene_file(loaded, settings.stations);
  parameters.temperature = raster(settings.temperature);
  parameters.temperature_factor = settings.temperature_factor;
  parameters.rain = raster(settings.rain);
  parameters.rain_factor = settings.rain_factor;
  parameters.sheltered = settings.sheltered;
  parameters.warmer_k = settings.warmer_k;
  parameters.wetter = settings.wetter;
  parameters.lapse_k_per_km = settings.lapse_k_per_km;
  parameters.wind_from_deg = settings.wind_from_deg;
  parameters.latitude_deg = settings.latitude_deg;
  return make_climate(
      dem, parameters,
      [](glm::dvec2 lonlat_deg) { return default_climate(lonlat_deg.x, lonlat_deg.y); }, progress);
}

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

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double lakes_freeze_c = -3.0;  // mean of the coldest month below which lakes freeze
constexpr double first_turns_c = 11.5;
constexpr double all_turned_c = 6.5;
constexpr double turning_fall_k = 6.0;
constexpr int autumn_days = 230;  // after the warmest one: until then nothing grows again

bool has_alpine_altitudes(const std::string& palette) {
  return palette == "summer" || palette == "autumn" || palette == "winter";
}

// Whether rules classify the scene, with the treeline of its climate.
bool takes_treeline(const LoadedScene& loaded) {
  const SceneLandCover& cover = loaded.scene.land_cover;
  if (!cover.sources.empty() ||
      !uses_variable(read_class_rules(find_named_file(loaded, "layers", cover.rules)), "treeline"))
    return false;
  return std::none_of(cover.settings.begin(), cover.settings.end(), [](const auto& setting) {
    return setting.first == "treeline_m" && setting.second > 0.0;
  });
}

}  // namespace

std::optional<int> day_of_season(const SceneSeason& season) {
  if (season.date.empty()) return std::nullopt;
  constexpr std::array<int, 12> before = {0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334};
  const int month = std::stoi(season.date.substr(0, 2));
  const int day = std::stoi(season.date.substr(3));
  return before[static_cast<std::size_t>(month - 1)] + (month == 2 ? std::min(day, 28) : day) - 1;
}

double autumn_share(const std::array<double, 365>& days_c, int day) {
  const auto warmest = std::max_element(days_c.begin(), days_c.end());
  const int since = (day - static_cast<int>(warmest - days_c.begin()) + 365) % 365;
  if (since > autumn_days) return 0.0;
  const double now_c = days_c[static_cast<std::size_t>(day)];
  const double cold = (first_turns_c - now_c) / (first_turns_c - all_turned_c);
  const double fallen = (*warmest - now_c) / turning_fall_k;
  return std::clamp(std::min(cold, fallen), 0.0, 1.0);
}

double lakes_freeze_from_m(const PlaceClimate& climate) {
  const Months at_0 = monthly_c(climate, 0.0);
  const auto coldest =
      static_cast<std::size_t>(std::min_element(at_0.begin(), at_0.end()) - at_0.begin());
  const double lapse_k_per_m = climate.lapse_k_per_km[coldest] / 1000.0;
  if (at_0[coldest] <= lakes_freeze_c) return -infinity;
  return lapse_k_per_m > 0.0 ? (at_0[coldest] - lakes_freeze_c) / lapse_k_per_m : infinity;
}

namespace {

double scene_lakes_freeze_from_m(const Palette& palette, const LoadedScene& loaded,
                                 const Dem& dem) {
  const std::string& asked = loaded.scene.season.frozen_lakes;
  if (!palette.winter || asked == "never") return infinity;
  if (asked == "always") return -infinity;
  if (!knows_place(loaded.scene, dem)) return infinity;
  const Climate climate = make_scene_climate(loaded, dem, silent_progress());
  return lakes_freeze_from_m(climate.at(0.5 * (dem.width() - 1), 0.5 * (dem.height() - 1)));
}

// In dry country, where it is known (terrain/climate/default_climate.h), the colours of steppe and
// desert at the altitudes that are as dry.
Palette palette_in_dry_country(const Palette& palette, const PlaceClimate& climate, float lowest_m,
                               float highest_m) {
  if (climate.dry_air <= 0.0) return palette;
  const auto low = static_cast<double>(lowest_m);
  const auto high = static_cast<double>(highest_m);
  // `moisture` at which each begins and is full: open woods to grass, tufts to bare ground. Heights
  // above dry ground are paler than those of wet countries, though cold enough to be moist.
  const auto share = [&](double begins, double full) {
    const auto own = [&climate, begins, full](double altitude_m) {
      return smoothstep((begins - plant_water_share(climate, altitude_m)) / (begins - full));
    };
    return
        [own, pale = 0.6 * own(low)](double altitude_m) { return std::max(own(altitude_m), pale); };
  };
  return mix_palettes(mix_palettes(palette, read_palette("steppe"), share(0.62, 0.42), low, high),
                      read_palette("high_desert"), share(0.34, 0.18), low, high);
}

}  // namespace

Palette palette_for_location(const Palette& named, const LoadedScene& loaded, const Dem& dem) {
  const Scene& scene = loaded.scene;
  Palette palette = named;
  palette.lakes_freeze_from_m = scene_lakes_freeze_from_m(named, loaded, dem);
  const std::optional<int> day = day_of_season(scene.season);
  const bool moves = has_alpine_altitudes(scene.palette) && takes_treeline(loaded);
  const bool turns = day && scene.palette == "summer" && scene.synthesis.colours == "palette";
  const bool dries = scene.palette == "summer" && scene.synthesis.colours == "palette";
  if ((!moves && !turns && !dries) || !knows_place(scene, dem)) return palette;

  const Climate climate = make_scene_climate(loaded, dem, silent_progress());
  const PlaceClimate centre = climate.at(0.5 * (dem.width() - 1), 0.5 * (dem.height() - 1));
  const double higher_m = moves ? treeline_m(centre) - palette_treeline_m : 0.0;
  Palette moved = palette_at_other_altitudes(palette, higher_m);
  const auto [lowest, highest] = std::minmax_element(dem.altitude_m.begin(), dem.altitude_m.end());
  if (dries) moved = palette_in_dry_country(moved, centre, *lowest, *highest);
  if (!turns) return moved;

  const Palette autumn = palette_at_other_altitudes(read_palette("autumn"), higher_m);
  const auto share = [&](double altitude_m) {
    return autumn_share(daily_c(monthly_c(centre, altitude_m)), *day);
  };
  return mix_palettes(moved, autumn, share, static_cast<double>(*lowest),
                      static_cast<double>(*highest));
}

}  // namespace belvedere
