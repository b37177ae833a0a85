#include "terrain/climate/water_balance.h"

#include <algorithm>
#include <cstddef>

namespace belvedere {

namespace {

constexpr double dry_air_from_c = -3.0;

double month_demand_mm(double mean_c, double dry_air, const WaterBalanceParameters& parameters) {
  const double mild = std::clamp(mean_c, 0.0, 30.0);
  const double dry = std::clamp(mean_c - dry_air_from_c, 0.0, 30.0);
  return (mild + dry_air * dry) * parameters.mm_per_kelvin / 12.0;
}

}  // namespace

double plant_water_demand_mm(const PlaceClimate& climate, double altitude_m,
                             const WaterBalanceParameters& parameters) {
  double year_mm = 0.0;
  for (const double mean_c : monthly_c(climate, altitude_m))
    if (mean_c >= 0.0) year_mm += month_demand_mm(mean_c, climate.dry_air, parameters);
  return year_mm;
}

double plant_water_share(const PlaceClimate& climate, double altitude_m,
                         const WaterBalanceParameters& parameters) {
  const Months mean_c = monthly_c(climate, altitude_m);
  const Months falls_mm = monthly_rain_mm(climate, altitude_m);
  constexpr int years = 4;  // until the state repeats yearly: the soil forgets within one or two
  double soil_mm = parameters.soil_mm;
  double snow_mm = 0.0;
  double wanted_mm = 0.0;
  double used_mm = 0.0;
  for (int year = 0; year < years; ++year) {
    wanted_mm = 0.0;
    used_mm = 0.0;
    // Snow of a year without thaw would accumulate for ever.
    snow_mm = std::min(snow_mm, 2000.0);
    for (std::size_t m = 0; m < mean_c.size(); ++m) {
      if (mean_c[m] < 0.0) {
        const double dried_mm = climate.dry_air * parameters.sublimation_mm;
        snow_mm += std::max(0.0, falls_mm[m] - dried_mm);
        continue;
      }
      const double could_mm = month_demand_mm(mean_c[m], climate.dry_air, parameters);
      const double there_mm = soil_mm + snow_mm + falls_mm[m];
      snow_mm = 0.0;
      const double taken_mm = std::min(could_mm, there_mm);
      soil_mm = std::min(parameters.soil_mm, there_mm - taken_mm);
      wanted_mm += could_mm;
      used_mm += taken_mm;
    }
  }
  return wanted_mm > 0.0 ? used_mm / wanted_mm : 1.0;
}

}  // namespace belvedere
