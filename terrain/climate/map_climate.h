#pragma once

#include <optional>

#include "base/progress.h"
#include "terrain/climate/climate.h"
#include "terrain/climate/map_position.h"
#include "terrain/climate/radiation.h"
#include "terrain/climate/rule_climate.h"
#include "terrain/io/dem.h"

namespace belvedere {

struct MapClimateParameters {
  std::optional<int>
      day_of_season;  // 0…364, day of the year for season_snow_m; none: perennial snow only
};

// A climate in the form that class rules use: lines on posts 10 km apart (at most 12 along a side),
// moisture and rain every 2 km (at most 48), sun cell by cell. Altitudes of lines are rounded to
// 1/16 m and the rest to 1/65536, so that the last bits of a machine do not affect a picture. The
// same bits for any threads.
RuleClimate make_map_climate(const Dem& dem, const Climate& climate,
                             const MapClimateParameters& parameters);
// Only its lines, without tables.
RuleClimate make_map_lines(const Dem& dem, const Climate& climate,
                           const MapClimateParameters& parameters);

struct SunShareParameters {
  double cell_m = 90.0;  // the sun is computed on cells of at least this size, 0…1000
  int azimuths = 16;     // 8…360, directions of horizon
  MonthShares sunshine = always_sunny;
};
// Annual sun (Radiation::direct_mj_m2) divided by that of level open ground at the same position, 0
// … about 2, computed on coarser cells and interpolated.
Grid<float> sun_share(const Dem& dem, const MapPosition& position,
                      const SunShareParameters& parameters, Progress& progress = silent_progress());
// The same on a window of a larger terrain; shadows from up to 24 km around the window are
// included. `latitude_deg`: see make_map_position.
Grid<float> sun_share(const Dem& window, const Dem& whole, std::optional<double> latitude_deg,
                      const SunShareParameters& parameters, Progress& progress = silent_progress());

}  // namespace belvedere
