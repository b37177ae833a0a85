#pragma once

#include "base/grid.h"
#include "base/progress.h"
#include "terrain/climate/map_place.h"
#include "terrain/climate/sun_year.h"

namespace belvedere {

struct RadiationParameters {
  int azimuths = 32;  // 8…360: directions of horizon and sky
  SunYearParameters sun;
};

// What ground gets of a clear sky.
struct Radiation {
  // Potential direct radiation from the first day to the last, MJ on a m² of the ground as it is inclined; NaN where the ground is void.
  Grid<float> direct_mj_m2;
  // Share of the light of an evenly bright sky that is left to level ground: mean of cos² of the horizon, where the ground's own slope
  // counts as horizon. 0…1, NaN where the ground is void.
  Grid<float> sky_view;
};

// Horizons by sweeps (horizon_sweep.h), one a direction, for however many days; the sun's places as sums by the tangent of their elevation
// (SunTable), so that a cell costs one look-up a direction. Altitudes in m, voids NaN: they hide nothing, and get nothing. Latitude and
// true north are those of each cell; horizons are looked for by true north in the middle of the map. Beyond the map nothing stands.
// Beside its results it keeps some hundred kilobytes a thread. The same bits for any threads.
Radiation potential_radiation(const Grid<float>& altitude_m, const MapPlace& place, const RadiationParameters& parameters,
                              Progress& progress = silent_progress());

}  // namespace belvedere
