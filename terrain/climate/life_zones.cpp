#include "terrain/climate/life_zones.h"

namespace belvedere {

double treeline_m(const PlaceClimate& climate, double warmer_k,
                  const TreelineParameters& parameters) {
  return highest_m([&](double m) {
    Months months = monthly_c(climate, m);
    for (double& t : months) t += warmer_k;
    const GrowingSeason season = growing_season(months, parameters.limit_c);
    return season.days >= parameters.min_days && season.mean_c >= parameters.min_mean_c;
  });
}

}  // namespace belvedere
