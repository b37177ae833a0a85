#pragma once

#include "base/grid.h"
#include "base/progress.h"
#include "terrain/climate/map_position.h"
#include "terrain/climate/sun_year.h"

namespace belvedere {

struct RadiationParameters {
  int azimuths = 32;  // 8…360: directions of horizon and sky
  SunYearParameters sun;
};

// Clear-sky light on the ground.
struct Radiation {
  // Potential direct radiation from the first day to the last, MJ per m² of inclined ground; NaN
  // where the ground is void.
  Grid<float> direct_mj_m2;
  // Sky-view factor: share of the light of a uniform sky that reaches level ground, the mean of
  // cos² of the horizon, which includes the ground's own slope. 0…1, NaN where the ground is void.
  Grid<float> sky_view;
};

// Horizons by sweeps (horizon_sweep.h), one per direction for all days; positions of the sun as
// sums by the tangent of their elevation (SunTable), so that a cell costs one look-up per
// direction. Altitudes in m; voids (NaN) cast no shadow and get no result. Latitude and true north
// are those of each cell; horizons use true north at the centre of the map. There is nothing beyond
// the map. Uses some hundred kilobytes per thread besides its results. The same bits for any
// threads.
Radiation potential_radiation(const Grid<float>& altitude_m, const MapPosition& position,
                              const RadiationParameters& parameters,
                              Progress& progress = silent_progress());

}  // namespace belvedere
