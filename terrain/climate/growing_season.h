#pragma once

#include <array>
#include <functional>

namespace belvedere {

struct PlaceClimate;
using Months = std::array<double, 12>;  // January … December

// What grows where, from twelve monthly means of temperature and the rain of a year.

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
// Where forest ends on level ground that gets rain enough, m; `warmer_k` moves all months. -2000 where trees grow nowhere, 9000 where they
// grow up to there.
double treeline_m(const PlaceClimate& climate, double warmer_k = 0.0, const TreelineParameters& parameters = {});

// What slopes get of the sun, in kelvin of the air: share 1 is level ground's potential radiation of a year (0…1.6). Trees are bound to
// the air and feel little of it (Körner 2012); snow feels more, so that snow lines lie 300 to 400 m higher on sunny sides, treelines 150.
struct SlopeWarmth {
  double trees_k = 2.0;  // K for the radiation of level ground
  double snow_k = 4.5;
};
double radiation_warmth_k(double share, double kelvin_a_share);

struct Dryness {
  double biotemperature_c = 0.0;  // mean of the months, each held within 0…30 (Holdridge 1967, Life zone ecology)
  double thirst = 0.0;            // what plants could evaporate, 58.93 mm a kelvin of biotemperature, over what falls; 0…100
  double martonne = 0.0;          // mm / (°C + 10) (de Martonne 1926); 0 for means below -9 °C, where it means nothing
  double forest = 1.0;            // 0…1: closed forest, open woods, none; the rest is steppe
  double desert = 0.0;            // 0…1: bare ground instead of steppe
};
Dryness dryness(const Months& months, double rain_mm);
// Where dry steppe gives way to forest above it, m; -2000 where no place is too dry below the treeline, 9000 where all are.
double lower_treeline_m(const PlaceClimate& climate);

// The highest altitude, -2000…9000 m, where something holds: looked for from above in steps of 100 m, then by halving to a millimetre.
double highest_m(const std::function<bool(double)>& holds);

}  // namespace belvedere
