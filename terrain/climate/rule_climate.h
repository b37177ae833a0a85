#pragma once

#include <vector>

#include "base/grid.h"
#include "terrain/io/raster.h"

namespace belvedere {

// What class rules know of the climate of a map. Lines change slowly from place to place, so they stand on posts some kilometres apart, and
// what hangs on altitude as well is a table of it at posts of its own; both are linear in between and constant beyond.
struct RuleClimate {
  GeoTransform line_posts;                 // of the grids below, all of one size, in the DEM's CRS
  Grid<float> treeline_m;                  // altitude where forest ends on level ground
  Grid<float> ice_line_m;                  // altitude where as much snow falls as melts, in hollows that gather it
  Grid<float> snow_line_m;                 // the same on open ground, higher
  Grid<float> season_snow_m;               // altitude above which snow lies on the season's date; no_season_snow_m without a date
  GeoTransform table_posts;                // of the tables below, the same
  double lowest_m = 0.0;                   // altitude of the first grid of each table …
  double step_m = 200.0;                   // … and between them
  std::vector<Grid<float>> moisture;       // 0…1, share of the water that plants could use which they get
  std::vector<Grid<float>> temperature_c;  // mean of the year
  std::vector<Grid<float>> rain_mm;        // of the year
  // Direct sun of the year over that of level open ground in the same place, at each cell of the DEM; empty: from exposure and slope.
  Grid<float> sun;
};
inline constexpr float no_season_snow_m = 1e5F;

// What such tables are asked for.
enum class ClimateVariable : int { treeline, ice_line, snow_line, season_snow, moisture, temperature, rain };

// The northern edge of the Alps, everywhere the same: for a terrain that is nowhere, and for tests.
RuleClimate alpine_climate();

// Where the columns of a DEM lie among the posts: the same in every row.
struct ClimateColumns {
  struct Between {
    int low;
    int high;
    float share;  // of `high`
  };
  std::vector<Between> lines;
  std::vector<Between> tables;
};
// Error(bug) where grids of the same posts differ in size.
ClimateColumns plan_climate_columns(const RuleClimate& climate, const GeoTransform& transform, int width);

// One row of a variable at the cells (0…width-1, y) of a DEM with that transform; `altitude_m` are their altitudes.
void fill_climate_row(const RuleClimate& climate, const ClimateColumns& columns, ClimateVariable variable, const GeoTransform& transform,
                      int y, const float* altitude_m, float* out);
void fill_climate_row(const RuleClimate& climate, ClimateVariable variable, const GeoTransform& transform, int y, int width,
                      const float* altitude_m, float* out);

}  // namespace belvedere
