#include "terrain/climate/growing_season.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "base/math.h"
#include "base/math_exact.h"
#include "terrain/climate/zonal_climate.h"

namespace belvedere {
namespace {

constexpr double lowest_m = -2000.0;
constexpr double greatest_m = 9000.0;

using DayWeights = std::array<std::array<double, 12>, 365>;

// What each month counts on each day.
DayWeights make_day_weights() {
  constexpr double pi = std::numbers::pi;
  DayWeights weights{};
  for (int day = 0; day < 365; ++day)
    for (int month = 0; month < 12; ++month) {
      const double months_off = (day + 0.5) * 12.0 / 365.0 - (month + 0.5);
      double sum = 1.0 / 12.0;
      for (int wave = 1; wave <= 6; ++wave) {
        // The mean over a month leaves sin(x) / x of a wave, x half a month in radians. The sixth wave has no second phase.
        const double x = pi * wave / 12.0;
        const double share = wave == 6 ? 1.0 / 12.0 : 2.0 / 12.0;
        sum += share * x / exact::sin(x) * exact::cos(2.0 * x * months_off);
      }
      weights[static_cast<std::size_t>(day)][static_cast<std::size_t>(month)] = sum;
    }
  return weights;
}

GrowingSeason season_of(const std::array<double, 365>& days, double warmer_k, double limit_c) {
  // Straight from day to day, so that the season changes smoothly with its temperatures.
  double length = 0.0;
  double heat = 0.0;
  for (std::size_t d = 0; d < 365; ++d) {
    const double a = days[d] + warmer_k - limit_c;
    const double b = days[(d + 1) % 365] + warmer_k - limit_c;
    if (a <= 0.0 && b <= 0.0) continue;
    if (a > 0.0 && b > 0.0) {
      length += 1.0;
      heat += 0.5 * (a + b);
      continue;
    }
    const double top = std::max(a, b);
    const double part = top / std::abs(a - b);
    length += part;
    heat += 0.5 * top * part;
  }
  return {length, length > 0.0 ? limit_c + heat / length : 0.0};
}

}  // namespace

std::array<double, 365> daily_c(const Months& months) {
  static const DayWeights weights = make_day_weights();
  std::array<double, 365> days{};
  for (std::size_t d = 0; d < 365; ++d) {
    double sum = 0.0;
    for (std::size_t m = 0; m < 12; ++m) sum += weights[d][m] * months[m];
    days[d] = sum;
  }
  return days;
}

GrowingSeason growing_season(const Months& months, double limit_c) { return season_of(daily_c(months), 0.0, limit_c); }

double treeline_excess_k(const Months& months, const TreelineParameters& parameters) {
  const std::array<double, 365> days = daily_c(months);
  double grows = 60.0;
  double does_not = -60.0;
  while (grows - does_not > 1e-6) {
    const double middle = 0.5 * (grows + does_not);
    const GrowingSeason season = season_of(days, middle, parameters.limit_c);
    (season.days >= parameters.least_days && season.mean_c >= parameters.least_mean_c ? grows : does_not) = middle;
  }
  return grows;
}

double highest_m(const std::function<bool(double)>& holds) {
  double no = greatest_m;
  if (holds(no)) return no;
  double yes = no;
  while (yes > lowest_m) {
    yes -= 100.0;
    if (holds(yes)) break;
    no = yes;
  }
  if (no <= lowest_m) return lowest_m;
  while (no - yes > 1e-3) {
    const double middle = 0.5 * (no + yes);
    (holds(middle) ? yes : no) = middle;
  }
  return yes;
}

double treeline_m(const PlaceClimate& climate, double warmer_k, const TreelineParameters& parameters) {
  return highest_m([&](double m) {
    const GrowingSeason season = season_of(daily_c(monthly_c(climate, m)), warmer_k, parameters.limit_c);
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
  if (too_dry(top)) return greatest_m;
  return highest_m([&](double m) { return m < top && too_dry(m); });
}

}  // namespace belvedere
