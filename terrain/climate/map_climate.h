#pragma once

#include <optional>

#include "base/progress.h"
#include "terrain/climate/climate.h"
#include "terrain/climate/map_place.h"
#include "terrain/climate/rule_climate.h"
#include "terrain/io/dem.h"

namespace belvedere {

struct MapClimateParameters {
  std::optional<int> day_of_season;  // 0…364 of the year, whose snow is asked for; none: only what lies all summer
};

// A climate as class rules take it: lines on posts 10 km apart (12 along a side at most), moisture and rain every 2 km (48 at most), sun
// cell by cell. Altitudes of lines are rounded to 1/16 m and the rest to 1/65536, so that a machine's last bits do not reach a picture. The
// same bits for any threads.
RuleClimate make_map_climate(const Dem& dem, const Climate& climate, const MapClimateParameters& parameters);
// Its lines alone, without tables.
RuleClimate make_map_lines(const Dem& dem, const Climate& climate, const MapClimateParameters& parameters);

struct SunShareParameters {
  double cell_m = 90.0;  // the sun is computed on cells of at least that size, 0…1000
  int azimuths = 16;     // 8…360, directions of horizon
};
// Direct sun of the year over that of level open ground at the same place, 0 … some 2, on coarser cells, interpolated.
Grid<float> sun_share(const Dem& dem, const MapPlace& place, const SunShareParameters& parameters, Progress& progress = silent_progress());
// The same on a window of a larger terrain, of which 24 km around the window throw their shadows into it. `latitude_deg`: make_map_place.
Grid<float> sun_share(const Dem& window, const Dem& whole, std::optional<double> latitude_deg, const SunShareParameters& parameters,
                      Progress& progress = silent_progress());

}  // namespace belvedere
