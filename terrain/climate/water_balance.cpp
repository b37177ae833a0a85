#include "terrain/climate/water_balance.h"

#include <algorithm>
#include <cstddef>

namespace belvedere {

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
      const double could_mm = std::clamp(mean_c[m], 0.0, 30.0) * parameters.mm_per_kelvin / 12.0;
      if (mean_c[m] < 0.0) {
        snow_mm += falls_mm[m];
        continue;
      }
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
