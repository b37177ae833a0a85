#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/config.h"
#include "base/grid.h"
#include "base/parallel.h"
#include "terrain/io/raster.h"

namespace belvedere {

// The climate of a map for class rules. Lines change slowly with position, so they are stored on
// posts some kilometres apart. Values that also depend on altitude are tables of it at posts of
// their own. Both are linear in between and constant beyond.
struct RuleClimate {
  GeoTransform line_posts;  // of the grids below, all of one size, in the DEM's CRS
  Grid<float> treeline_m;   // altitude of the treeline on level ground
  Grid<float>
      ice_line_m;  // altitude at which accumulation equals melt in hollows that collect snow
  Grid<float> snow_line_m;                 // the same on open ground, higher
  Grid<float> season_snow_m;               // altitude above which snow lies on the season's date;
                                           // no_season_snow_m without a date
  GeoTransform table_posts;                // of the tables below, which share it
  double lowest_m = 0.0;                   // altitude of the first grid of each table …
  double step_m = 200.0;                   // … and step between them
  std::vector<Grid<float>> moisture;       // 0…1, available water divided by the demand of plants
  std::vector<Grid<float>> temperature_c;  // mean of the year
  std::vector<Grid<float>> rain_mm;        // of the year
  // Annual direct sun divided by that of level open ground at the same position, for each cell of
  // the DEM; empty: estimated from exposure and slope.
  Grid<float> sun;
};
inline constexpr float no_season_snow_m = 1e5F;

// The variables of such tables.
enum class ClimateVariable : int {
  treeline,
  ice_line,
  snow_line,
  season_snow,
  moisture,
  temperature,
  rain
};

// The northern edge of the Alps, uniform: for a terrain without a position, and for tests.
RuleClimate alpine_climate();

// Positions of a DEM's columns among the posts: the same in every row.
struct ClimateColumns {
  struct Between {
    int low;
    int high;
    float share;  // of `high`
  };
  std::vector<Between> lines;
  std::vector<Between> tables;
};
// Error(bug) if grids of the same posts differ in size.
ClimateColumns plan_climate_columns(const RuleClimate& climate, const GeoTransform& transform,
                                    int width);

// One row of a variable at the cells (0…width-1, y) of a DEM with that transform, whose altitudes
// are `altitude_m`.
void fill_climate_row(const RuleClimate& climate, const ClimateColumns& columns,
                      ClimateVariable variable, const GeoTransform& transform, int y,
                      const float* altitude_m, float* out);
void fill_climate_row(const RuleClimate& climate, ClimateVariable variable,
                      const GeoTransform& transform, int y, int width, const float* altitude_m,
                      float* out);

// The tables of places that the climate ships with: TOML files of version 1 with one list of rows.

// A row; columns from 0. Error(usage) with the line of a value that is no number in its range, or
// no text.
class ClimateRow {
 public:
  ClimateRow(const ConfigArray& values, const std::string& name) : values_(values), name_(name) {}
  double number(std::size_t column, double min, double max) const {
    return as_number(values_[column], name_, min, max);
  }
  std::string text(std::size_t column) const { return as_string(values_[column], name_); }

 private:
  const ConfigArray& values_;
  const std::string& name_;
};

struct ClimateTable {
  const char* list;     // "glaciers"
  const char* one;      // "glacier"
  std::size_t columns;  // of every row
  const char* values;   // what they are: "name, latitude, …"
};
// Error(usage) for another file, and with the line of a row of another length.
void for_each_row(const std::string& text, const std::string& name, const ClimateTable& table,
                  FunctionRef<void(const ClimateRow&)> use);

}  // namespace belvedere
