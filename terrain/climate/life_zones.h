#pragma once

#include "terrain/climate/zonal_climate.h"

namespace belvedere {

// Where forest, steppe and desert are, by climate alone. docs/life_zones.md.

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

}  // namespace belvedere
