#include "terrain/climate/lapse_rate.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/random.h"
#include "base/statistics.h"

namespace belvedere {
namespace {

constexpr double min_rise_m = 50.0;
constexpr std::uint64_t lapse_seed =
    0x6c61707365ULL;  // not a stream of pictures: only a range in a report depends on it

struct Sample {
  double altitude_m;
  double temperature_c;
};

// The slope between two samples; its weight is the altitude difference, because the noise of both
// is divided by it (Jaeckel 1972).
struct PairSlope {
  double per_m;
  double weight;
};

struct Line {
  double at_zero = 0.0;
  double per_m = 0.0;
};

// The weighted median.
double weighted_median_of(std::vector<PairSlope>& slopes) {
  std::sort(slopes.begin(), slopes.end(),
            [](const PairSlope& a, const PairSlope& b) { return a.per_m < b.per_m; });
  double all = 0.0;
  for (const PairSlope& slope : slopes) all += slope.weight;
  double below = 0.0;
  for (const PairSlope& slope : slopes) {
    below += slope.weight;
    if (below >= 0.5 * all) return slope.per_m;
  }
  return slopes.back().per_m;
}

// The number of pairs grows with the square of the stations: above this limit each station is
// compared only with those at certain distances in the list.
constexpr std::size_t max_pairs = 50000;

std::optional<Line> theil_sen(const std::vector<Sample>& samples) {
  const std::size_t n = samples.size();
  std::vector<PairSlope> slopes;
  const std::size_t stride = 1 + n * (n - 1) / 2 / max_pairs;
  for (std::size_t apart = 1; apart < n; apart += stride)
    for (std::size_t i = 0; i + apart < n; ++i) {
      const Sample& a = samples[i];
      const Sample& b = samples[i + apart];
      if (std::abs(b.altitude_m - a.altitude_m) > min_rise_m)
        slopes.push_back({(b.temperature_c - a.temperature_c) / (b.altitude_m - a.altitude_m),
                          std::abs(b.altitude_m - a.altitude_m)});
    }
  if (slopes.empty()) return {};
  Line line;
  line.per_m = weighted_median_of(slopes);
  std::vector<double> rest;
  for (const Sample& s : samples) rest.push_back(s.temperature_c - line.per_m * s.altitude_m);
  line.at_zero = median(rest);
  return line;
}

}  // namespace

LapseRate fit_lapse_rate(const std::vector<double>& altitude_m,
                         const std::vector<double>& temperature_c, int bootstrap_samples) {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < std::min(altitude_m.size(), temperature_c.size()); ++i)
    if (!std::isnan(altitude_m[i]) && !std::isnan(temperature_c[i]))
      samples.push_back({altitude_m[i], temperature_c[i]});
  const std::optional<Line> line = samples.size() < 3 ? std::nullopt : theil_sen(samples);
  if (!line)
    throw Error(
        ErrorKind::input, "stations",
        fmt::format("{} stations with a temperature, or all at the same altitude", samples.size()),
        "at least 3 stations with altitude differences of 50 m or more");
  LapseRate rate{.sea_level_c = line->at_zero,
                 .k_per_km = -1000.0 * line->per_m,
                 .stations = static_cast<int>(samples.size())};

  const auto count = static_cast<std::uint32_t>(samples.size());
  std::vector<double> rates;
  std::vector<Sample> drawn(samples.size());
  for (int sample = 0; sample < bootstrap_samples; ++sample) {
    for (std::uint32_t i = 0; i < count; ++i)
      drawn[i] = samples[random_index(count, lapse_seed, sample, i)];
    if (const std::optional<Line> again = theil_sen(drawn)) rates.push_back(-1000.0 * again->per_m);
  }
  std::sort(rates.begin(), rates.end());
  rate.low_k_per_km =
      rates.empty()
          ? rate.k_per_km
          : rates[static_cast<std::size_t>(0.025 * static_cast<double>(rates.size() - 1))];
  rate.high_k_per_km =
      rates.empty()
          ? rate.k_per_km
          : rates[static_cast<std::size_t>(0.975 * static_cast<double>(rates.size() - 1))];

  // Of many stations a hundred are left out in turn.
  const std::size_t step = 1 + samples.size() / 100;
  double sum = 0.0;
  int left_out = 0;
  for (std::size_t i = 0; i < samples.size(); i += step) {
    std::vector<Sample> others = samples;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const std::optional<Line> without = theil_sen(others);
    if (!without) continue;
    const double error =
        samples[i].temperature_c - (without->at_zero + without->per_m * samples[i].altitude_m);
    sum += error * error;
    ++left_out;
  }
  rate.left_out_k = left_out > 0 ? std::sqrt(sum / left_out) : 0.0;
  return rate;
}

}  // namespace belvedere
