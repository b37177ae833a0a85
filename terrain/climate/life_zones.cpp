#include "terrain/climate/life_zones.h"

#include <algorithm>

#include "base/math.h"

namespace belvedere {

double treeline_m(const PlaceClimate& climate, double warmer_k, const TreelineParameters& parameters) {
  return highest_m([&](double m) {
    Months months = monthly_c(climate, m);
    for (double& t : months) t += warmer_k;
    const GrowingSeason season = growing_season(months, parameters.limit_c);
    return season.days >= parameters.least_days && season.mean_c >= parameters.least_mean_c;
  });
}

double radiation_warmth_k(double share, double kelvin_a_share) { return (std::clamp(share, 0.0, 1.6) - 1.0) * kelvin_a_share; }

Dryness dryness(const Months& months, double rain_mm) {
  Dryness dry;
  double mean = 0.0;
  for (const double t : months) {
    dry.biotemperature_c += std::clamp(t, 0.0, 30.0) / 12.0;
    mean += t / 12.0;
  }
  dry.thirst = std::min(100.0, 58.93 * dry.biotemperature_c / std::max(rain_mm, 1.0));
  dry.martonne = mean > -9.0 ? rain_mm / (mean + 10.0) : 0.0;
  // Holdridge's dry forests lie between 1 and 2, his steppe and scrub between 2 and 4, deserts beyond; woods thin out over these.
  dry.forest = 1.0 - smoothstep(1.0, 1.8, dry.thirst);
  dry.desert = smoothstep(3.5, 8.0, dry.thirst);
  return dry;
}

double lower_treeline_m(const PlaceClimate& climate) {
  const double top = treeline_m(climate);
  const auto too_dry = [&](double m) { return dryness(monthly_c(climate, m), rain_mm(climate, m)).forest < 0.5; };
  if (too_dry(top)) return highest_line_m;
  return highest_m([&](double m) { return m < top && too_dry(m); });
}

}  // namespace belvedere
