#include "terrain/climate/water_balance.h"

#include <algorithm>
#include <cstddef>

#include "base/math.h"

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

namespace {

// Mean of three consecutive months.
double warmest_three(const Months& months) {
  double warmest = -1e9;
  for (std::size_t m = 0; m < 12; ++m)
    warmest = std::max(warmest, (months[m] + months[(m + 1) % 12] + months[(m + 2) % 12]) / 3.0);
  return warmest;
}

// The mean of the part above 0 °C if days deviate by up to `weather_k` from `mean_c`, uniformly: a
// parabola between nothing and the mean itself.
double thawing_k(double mean_c, double weather_k) {
  if (mean_c >= weather_k) return mean_c;
  return mean_c <= -weather_k ? 0.0 : square(mean_c + weather_k) / (4.0 * weather_k);
}

double snow_share(double temperature_c) { return unit((3.0 - temperature_c) / 4.0); }

Months warmed(Months months, double warmer_k) {
  for (double& t : months) t += warmer_k;
  return months;
}

constexpr double covered_mm = 20.0;  // a patchy cover: half of the ground

}  // namespace

Months monthly_snow_mm(const PlaceClimate& climate, double altitude_m, double warmer_k) {
  const Months t = warmed(monthly_c(climate, altitude_m), warmer_k);
  Months snow = monthly_rain_mm(climate, altitude_m);
  for (std::size_t m = 0; m < 12; ++m) snow[m] *= snow_share(t[m]);
  return snow;
}

double snow_to_last_mm(const Months& months) {
  constexpr double turn_c = -296.0 / 18.0;
  const double summer = std::max(turn_c, warmest_three(months));
  const double by_temperature = 296.0 * summer + 9.0 * summer * summer;
  const double endless_summer = unit(1.0 - (summer - year_mean(months)) / 6.0);
  return 645.0 + by_temperature * (by_temperature > 0.0 ? 1.0 + 3.0 * endless_summer : 1.0);
}

double snow_balance_mm(const PlaceClimate& climate, double altitude_m,
                       const SnowParameters& parameters) {
  double snow = 0.0;
  for (const double month : monthly_snow_mm(climate, altitude_m, parameters.warmer_k))
    snow += month;
  return parameters.gathering * climate.gathers * snow -
         snow_to_last_mm(warmed(monthly_c(climate, altitude_m), parameters.warmer_k));
}

double snow_line_m(const PlaceClimate& climate, const SnowParameters& parameters) {
  return highest_m([&](double m) { return snow_balance_mm(climate, m, parameters) < 0.0; });
}

double snow_cover_mm(const PlaceClimate& climate, double altitude_m, int day,
                     const SnowParameters& snow, const MeltParameters& melt) {
  const std::array<double, 365> t = daily_c(warmed(monthly_c(climate, altitude_m), snow.warmer_k));
  const std::array<double, 365> rain = daily_c(monthly_rain_mm(climate, altitude_m));
  // The snow year begins after the warmest days.
  std::size_t warmest = 0;
  for (std::size_t d = 1; d < 365; ++d)
    if (t[d] > t[warmest]) warmest = d;
  const std::size_t begin = warmest + 30;
  const std::size_t days = (static_cast<std::size_t>(std::clamp(day, 0, 364)) + 730 - begin) % 365;
  double lies = 0.0;
  for (std::size_t k = 0; k <= days; ++k) {
    const std::size_t d = (begin + k) % 365;
    const double falls = std::max(0.0, rain[d]) * 12.0 / 365.0 * snow_share(t[d]) * snow.gathering;
    lies = std::max(0.0, lies + falls - melt.melt_mm_per_k_day * thawing_k(t[d], melt.weather_k));
  }
  return lies;
}

double snow_line_of_day_m(const PlaceClimate& climate, int day, const SnowParameters& snow,
                          const MeltParameters& melt) {
  return highest_m(
      [&](double m) { return snow_cover_mm(climate, m, day, snow, melt) < covered_mm; });
}

}  // namespace belvedere
