#include "renderer/compose/region_climate.h"

#include <algorithm>
#include <vector>

#include "base/progress.h"
#include "terrain/climate/climate.h"
#include "terrain/climate/default_climate.h"
#include "terrain/climate/map_climate.h"

namespace belvedere {

RegionClimate region_climate(const CoarseGround& ground) {
  RegionClimate out;
  if (ground.crs.empty()) return out;
  Dem dem;
  dem.transform = ground.transform;
  dem.crs = ground.crs;
  dem.altitude_m = Grid<float>(ground.cells.width(), ground.cells.height());
  for (std::size_t i = 0; i < ground.cells.size(); ++i)
    dem.altitude_m[i] = ground.cells[i].altitude_m;
  dem.filled = Grid<std::uint8_t>(ground.cells.width(), ground.cells.height(), 0);
  const Climate climate = make_climate(
      dem, {}, [](glm::dvec2 lonlat_deg) { return default_climate(lonlat_deg.x, lonlat_deg.y); },
      silent_progress());
  const RuleClimate rules = make_map_climate(dem, climate, {});
  const int width = dem.width();
  std::vector<float> moisture(static_cast<std::size_t>(width)), rain(moisture.size()),
      warmth(moisture.size());
  double altitude_sum_m = 0.0;
  int known = 0;
  for (const auto& cell : ground.cells) {
    if (!cell.known) continue;
    altitude_sum_m += static_cast<double>(cell.altitude_m);
    ++known;
  }
  const double mean_m = altitude_sum_m / std::max(1, known);
  double sums[3] = {0.0, 0.0, 0.0};
  double low_sum = 0.0;
  double low_count = 0.0;
  double count = 0.0;
  for (int y = 0; y < dem.height(); ++y) {
    const float* altitude_m = dem.altitude_m.row(y);
    fill_climate_row(rules, ClimateVariable::moisture, dem.transform, y, width, altitude_m,
                     moisture.data());
    fill_climate_row(rules, ClimateVariable::rain, dem.transform, y, width, altitude_m,
                     rain.data());
    fill_climate_row(rules, ClimateVariable::temperature, dem.transform, y, width, altitude_m,
                     warmth.data());
    for (int x = 0; x < width; ++x) {
      if (!ground.cells(x, y).known) continue;
      const auto i = static_cast<std::size_t>(x);
      sums[0] += static_cast<double>(moisture[i]);
      sums[1] += static_cast<double>(rain[i]);
      sums[2] += static_cast<double>(warmth[i]);
      count += 1.0;
      if (static_cast<double>(altitude_m[x]) > mean_m) continue;
      low_sum += static_cast<double>(moisture[i]);
      low_count += 1.0;
    }
  }
  if (count == 0.0) return out;
  return {.known = true,
          .moisture = sums[0] / count,
          .low_moisture = low_sum / std::max(1.0, low_count),
          .rain_mm = sums[1] / count,
          .temperature_c = sums[2] / count};
}

bool is_canyon_country(const RegionClimate& climate) {
  constexpr double dry = 0.75, warm_c = 6.0;
  return climate.known && climate.moisture < dry && climate.temperature_c > warm_c;
}

std::string dry_palette(const RegionClimate& climate, double plateau) {
  constexpr double bare = 0.3, grass = 0.6, hot_c = 13.0, mostly = 0.5;
  if (!climate.known) return "";
  const bool canyons = is_canyon_country(climate);
  if (canyons && (plateau > mostly || climate.temperature_c > hot_c)) return "desert";
  if (climate.low_moisture < bare) return "high_desert";
  if (climate.low_moisture < grass || canyons) return "steppe";
  return "";
}

}  // namespace belvedere
