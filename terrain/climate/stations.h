#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "base/progress.h"

namespace belvedere {

// A position with a known climate: a weather station, or a cell of a gridded climate history, with
// its altitude.
struct Station {
  std::string name;
  std::string region;        // homogeneous area that it stands in; empty: not named
  glm::dvec2 position{0.0};  // x, y in the requested CRS
  double altitude_m = 0.0;
  std::array<double, 12> temperature_c;  // monthly means, NaN if unknown
  double temperature_year_c = 0.0;       // annual mean, NaN if unknown
  double rain_mm = 0.0;                  // mean annual sum, NaN if unknown
};

struct StationTable {
  std::string file;
  std::string period;  // "1984-10 … 2014-09"; empty if unknown
  std::vector<Station> stations;

  bool has_months() const;  // some station has all months
  bool has_temperature() const;
  bool has_rain() const;
};

// Minimum for a reliable lapse rate: with one wrong station, 10 give it to .4 K/km, 5 to 1.2.
inline constexpr int fewest_stations = 8;

// A table of points (terrain/io/points.h: CSV with lon and lat or east and north, GeoPackage …)
// with columns
//   altitude_m (or altitude, elevation, height), m;  t_1 … t_12, °C, or t_year;
//   rain_mm (or rain, precipitation), mm per year;  name;  region: see station_regions.h;
// empty fields: unknown. Or netCDF with monthly arrays lon, lat, hgt (lat, lon), time, temp and
// prcp (time, lat, lon), averaged over the last 30 years. `crs`: of the map. Throws Error(usage)
// with the missing column or array and for malformed numbers, else as read_points and
// read_number_arrays do; a note if there are fewer than fewest_stations.
StationTable read_stations(const std::string& path, const std::string& crs, Progress& progress);

// Lapse rate of temperature from stations, robust against a tenth of gross errors.
struct LapseRate {
  double sea_level_c = 0.0;
  double k_per_km = 0.0;       // decrease with altitude, so usually above 0
  double low_k_per_km = 0.0;   // 95 % of bootstrap samples lie between …
  double high_k_per_km = 0.0;  // … these
  double left_out_k = 0.0;     // rms error at a station when fitted to the others
  int stations = 0;            // number used
  double at(double altitude_m) const { return sea_level_c - k_per_km * altitude_m / 1000.0; }
};

// Theil–Sen: the median of the slopes between pairs of stations at least 50 m of altitude apart,
// weighted by that difference (Sen 1968, Jaeckel 1972), and the median of the residuals at 0 m. NaN
// values are left out. Error(input) if fewer than 3 stations, or no such pair, are left. The result
// is reproducible: bootstrap samples are drawn by counter.
LapseRate fit_lapse_rate(const std::vector<double>& altitude_m,
                         const std::vector<double>& temperature_c, int bootstrap_samples = 400);

}  // namespace belvedere
