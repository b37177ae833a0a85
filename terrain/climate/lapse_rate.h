#pragma once

#include <vector>

namespace belvedere {

// How temperature falls with altitude, from stations, a tenth of which may be grossly wrong.
struct LapseRate {
  double sea_level_c = 0.0;
  double k_per_km = 0.0;       // what it falls, so above 0 as a rule
  double low_k_per_km = 0.0;   // 95 % of bootstrap samples lie between …
  double high_k_per_km = 0.0;  // … these
  double left_out_k = 0.0;     // rms of the error at a station that the others foretell
  int stations = 0;            // that were used
  double at(double altitude_m) const { return sea_level_c - k_per_km * altitude_m / 1000.0; }
};

// Theil–Sen: the median of the slopes between pairs of stations 50 m of altitude or more apart, weighted by that (Sen 1968, Jaeckel 1972),
// and the median of what is left at 0 m. Values that are NaN are left out. Error(input) where fewer than 3 stations, or no such pair, are
// left. The same bits always: the samples of the bootstrap are drawn by counter.
LapseRate fit_lapse_rate(const std::vector<double>& altitude_m, const std::vector<double>& temperature_c, int bootstrap_samples = 400);

}  // namespace belvedere
