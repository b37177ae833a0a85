#include "terrain/climate/growing_season.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include "base/math_exact.h"

namespace belvedere {
namespace {

using DayWeights = std::array<std::array<double, 12>, 365>;

// The weight of each month on each day.
DayWeights make_day_weights() {
  constexpr double pi = std::numbers::pi;
  DayWeights weights{};
  for (int day = 0; day < 365; ++day)
    for (int month = 0; month < 12; ++month) {
      const double months_off = (day + 0.5) * 12.0 / 365.0 - (month + 0.5);
      double sum = 1.0 / 12.0;
      for (int wave = 1; wave <= 6; ++wave) {
        // The mean over a month reduces a wave to sin(x) / x of it, x half a month in radians. The
        // sixth wave has no second phase.
        const double x = pi * wave / 12.0;
        const double share = wave == 6 ? 1.0 / 12.0 : 2.0 / 12.0;
        sum += share * x / exact::sin(x) * exact::cos(2.0 * x * months_off);
      }
      weights[static_cast<std::size_t>(day)][static_cast<std::size_t>(month)] = sum;
    }
  return weights;
}

GrowingSeason season_of(const std::array<double, 365>& days, double warmer_k, double limit_c) {
  // Linear between days, so that the season changes smoothly with its temperatures.
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

GrowingSeason growing_season(const Months& months, double limit_c) {
  return season_of(daily_c(months), 0.0, limit_c);
}

double treeline_excess_k(const Months& months, const TreelineParameters& parameters) {
  const std::array<double, 365> days = daily_c(months);
  double grows = 60.0;
  double does_not = -60.0;
  while (grows - does_not > 1e-6) {
    const double centre = 0.5 * (grows + does_not);
    const GrowingSeason season = season_of(days, centre, parameters.limit_c);
    (season.days >= parameters.min_days && season.mean_c >= parameters.min_mean_c ? grows
                                                                                  : does_not) =
        centre;
  }
  return grows;
}

double highest_m(const std::function<bool(double)>& holds) {
  double no = highest_line_m;
  if (holds(no)) return no;
  double yes = no;
  while (yes > lowest_line_m) {
    yes -= 100.0;
    if (holds(yes)) break;
    no = yes;
  }
  if (no <= lowest_line_m) return lowest_line_m;
  while (no - yes > 1e-3) {
    const double centre = 0.5 * (no + yes);
    (holds(centre) ? yes : no) = centre;
  }
  return yes;
}

double year_mean(const Months& months) {
  return std::accumulate(months.begin(), months.end(), 0.0) / 12.0;
}

}  // namespace belvedere
