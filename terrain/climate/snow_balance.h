#pragma once

#include <array>

#include "terrain/climate/zonal_climate.h"

namespace belvedere {

// Where snow stays: from year to year, and on a day of the year.

struct SnowParameters {
  // Hollows where glaciers begin gather drifting snow and avalanches: they hold this many times what falls on the level (1 … 4). 1 is
  // open ground, below 1 ribs and lone cones that the wind sweeps. 2 is fitted to published equilibrium lines; see docs/life_zones.md.
  double gathering = 2.0;
  double warmer_k = 0.0;  // of all months, as by radiation
};

// What falls as snow in each month, mm of water: all of it below -1 °C, nothing above 3 °C, straight between (monthly means).
Months monthly_snow_mm(const PlaceClimate& climate, double altitude_m, double warmer_k = 0.0);

// What must fall in a year for snow to stay, mm of water: 645 + 296 T + 9 T², T the mean of the three warmest months (Ohmura, Kasser &
// Funk 1992, Climate at the equilibrium line of glaciers, Journal of Glaciology 38). That is for summers of three or four months. Towards
// the equator, where the year is one summer, melting goes on: what comes of T above 0 °C counts up to four times, as the mean of the year
// comes within 6 K of the summer's. Small below T = -16.4 °C, where the parabola turns.
double snow_to_last_mm(const Months& months);

// How much more falls in a year than would have to for snow to stay, mm of water; < 0: it melts away.
double snow_balance_mm(const PlaceClimate& climate, double altitude_m, const SnowParameters& parameters = {});

// The lowest altitude from which on snow stays all the way up to 9000 m (the glaciers' equilibrium line), m; -2000 where it stays
// everywhere, 9000 where nowhere.
double snow_line_m(const PlaceClimate& climate, const SnowParameters& parameters = {});

struct MeltParameters {
  double melt_mm_per_k_day = 4.5;  // of snow, between the 3 … 6 that are measured (Hock 2003, Journal of Hydrology 282)
  double weather_k = 4.0;          // > 0: how far days stray from the mean; lets snow melt a little below 0 °C
};
// Snow that lies on a day of the year (0…364, 0 is the first of January), mm of water: falls and melts day by day, from the end of the
// warmest season on; what outlasts that is counted for one year only.
double snow_cover_mm(const PlaceClimate& climate, double altitude_m, int day, const SnowParameters& snow = {1.0, 0.0},
                     const MeltParameters& melt = {});
// Where half of the ground is under snow on a day: the lowest altitude above which at least 20 mm of water lie, m, -2000…9000.
double snow_line_of_day_m(const PlaceClimate& climate, int day, const SnowParameters& snow = {1.0, 0.0}, const MeltParameters& melt = {});

}  // namespace belvedere
