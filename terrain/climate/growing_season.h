#pragma once

#include <array>
#include <functional>

namespace belvedere {

using Months = std::array<double, 12>;  // January … December
// Mean of twelve months of equal weight.
double year_mean(const Months& months);

// How long and how warm the year is for plants, from twelve monthly means.

// 365 days' means in degrees Celsius: the smooth yearly course whose means over twelfths of the year are the given ones exactly
// (trigonometric interpolation, each wave divided by what averaging over a month leaves of it). Day 0 is the first of January.
std::array<double, 365> daily_c(const Months& months);

struct GrowingSeason {
  double days = 0.0;    // 0…365, of means above the limit; parts of days count
  double mean_c = 0.0;  // of these days; 0 where there are none
};
// Days above .9 °C are those on which trees grow (Paulsen & Körner 2014, A climate-based model to predict potential treeline position
// around the globe, Alpine Botany 124).
GrowingSeason growing_season(const Months& months, double limit_c = 0.9);

struct TreelineParameters {
  double limit_c = 0.9;       // what a growing day has
  double least_days = 94.0;   // of them in a year
  double least_mean_c = 6.4;  // over them
};

// How many kelvin a place is above the isotherm where forest ends: by so much all months would have to be warmer for trees to grow (or
// colder, < 0, for them to stop). -60…60, continuous.
double treeline_excess_k(const Months& months, const TreelineParameters& parameters = {});

// Between which altitudes lines are looked for; what holds nowhere lies at the first, what holds everywhere at the second.
constexpr double lowest_line_m = -2000.0;
constexpr double highest_line_m = 9000.0;
// The highest altitude between them where something holds: looked for from above in steps of 100 m, then by halving to a millimetre.
double highest_m(const std::function<bool(double)>& holds);

}  // namespace belvedere
