#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "base/progress.h"

namespace belvedere {

// A place whose climate is known: a weather station, or a cell of a history of the climate, which has an altitude of its own.
struct Station {
  std::string name;
  glm::dvec2 place{0.0};  // x, y in the CRS that was asked for
  double altitude_m = 0.0;
  std::array<double, 12> temperature_c;  // means of months, NaN where not known
  double temperature_year_c = 0.0;       // mean of the year, NaN where not known
  double rain_mm = 0.0;                  // sum of a mean year, NaN where not known
};

struct StationTable {
  std::string file;
  std::string period;  // "1984-10 … 2014-09"; empty where the file does not say
  std::vector<Station> stations;

  bool has_months() const;  // some station knows each month
  bool has_temperature() const;
  bool has_rain() const;
};

// With fewer a lapse rate is a guess: 10 stations, one of them wrong, tell it to .4 K/km; 5 to 1.2.
inline constexpr int fewest_stations = 8;

// A table of points (terrain/io/points.h: CSV with lon and lat or east and north, GeoPackage …) with columns
//   altitude_m (or altitude, elevation, height), m;  t_1 … t_12, °C, or t_year;  rain_mm (or rain, precipitation), mm a year;  name;
// empty fields: not known. Or netCDF with arrays lon, lat, hgt (lat, lon), time, temp and prcp (time, lat, lon) of months: means of the
// last 30 years of it. `crs`: of the map. Throws Error(usage) naming the column or array that is missing and for text that is no number,
// else what read_points and read_number_arrays throw; a note where there are fewer stations than fewest_stations.
StationTable read_stations(const std::string& path, const std::string& crs, Progress& progress);

}  // namespace belvedere
