#pragma once

#include <vector>

namespace belvedere {

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
