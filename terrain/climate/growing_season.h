#pragma once

#include <array>
#include <functional>

namespace belvedere {

using Months = std::array<double, 12>;  // January … December
// Mean of twelve months of equal weight.
double year_mean(const Months& months);

// Length and warmth of the growing season, from twelve monthly means.

// Daily means of 365 days in degrees Celsius: the smooth annual cycle whose means over twelfths of
// the year are exactly the given ones (trigonometric interpolation, each wave divided by its
// attenuation in a monthly mean). Day 0 is 1 January.
std::array<double, 365> daily_c(const Months& months);

struct GrowingSeason {
  double days = 0.0;    // 0…365, days with means above the limit, fractions included
  double mean_c = 0.0;  // of these days; 0 if there are none
};
// Trees grow on days above .9 °C (Paulsen & Körner 2014, A climate-based model to predict potential
// treeline position around the globe, Alpine Botany 124).
GrowingSeason growing_season(const Months& months, double limit_c = 0.9);

struct TreelineParameters {
  double limit_c = 0.9;     // minimum of a growing day
  double min_days = 94.0;   // growing days in a year
  double min_mean_c = 6.4;  // mean of the growing days
};

// Distance from the treeline isotherm in kelvin: the amount by which all months would have to be
// warmer for trees to grow (or colder, < 0, for them to stop growing). -60…60, continuous.
double treeline_excess_k(const Months& months, const TreelineParameters& parameters = {});

// Altitude range in which lines are searched. A condition that holds nowhere gives the first, one
// that holds everywhere the second.
constexpr double lowest_line_m = -2000.0;
constexpr double highest_line_m = 9000.0;
// The highest altitude in that range at which a condition holds: searched from above in steps of
// 100 m, then by bisection to a millimetre.
double highest_m(const std::function<bool(double)>& holds);

}  // namespace belvedere
