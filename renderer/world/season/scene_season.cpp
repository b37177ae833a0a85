#include "renderer/world/season/scene_season.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string>

#include "base/math.h"
#include "renderer/world/season/palette_season.h"
#include "renderer/world/season/scene_climate.h"
#include "terrain/climate/growing_season.h"
#include "terrain/climate/life_zones.h"
#include "terrain/climate/water_balance.h"
#include "terrain/cover/class_rules.h"

namespace belvedere {
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

// In dry country, where it is known (terrain/climate/dry_places.h), the colours of steppe and
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
