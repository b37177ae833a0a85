#include "terrain/climate/zonal_climate.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/math.h"
#include "base/math_exact.h"
#include "base/text/embedded.h"
#include "terrain/climate/map_position.h"
#include "terrain/climate/rule_climate.h"

// Universal kriging (Cressie 1993): a value is a trend of latitude and altitude plus a sum over
// stations of their covariance with the position. Covariance falls with distance as 1 / (1 + d² /
// 2L²) (rational quadratic). It uses only sums and quotients, is smooth at the poles and across the
// date line, because d is the chord through the Earth, and stays positive definite with altitude as
// a fourth axis.

namespace belvedere {
namespace {

using DayWeights = std::array<std::array<double, 12>, 365>;

// The weight of each month on each day.
DayWeights make_day_weights() {
  constexpr double pi = std::numbers::pi;
  DayWeights weights{};
  for (int day = 0; day < 365; ++day)
    for (int month = 0; month < 12; ++month) {
      const double months_off = (day + 0.5) * 12.0 / 365.0 - (month + 0.5);
      double sum = 1.0 / 12.0;
      for (int wave = 1; wave <= 6; ++wave) {
        // The mean over a month reduces a wave to sin(x) / x of it, x half a month in radians. The
        // sixth wave has no second phase.
        const double x = pi * wave / 12.0;
        const double share = wave == 6 ? 1.0 / 12.0 : 2.0 / 12.0;
        sum += share * x / exact::sin(x) * exact::cos(2.0 * x * months_off);
      }
      weights[static_cast<std::size_t>(day)][static_cast<std::size_t>(month)] = sum;
    }
  return weights;
}

GrowingSeason season_of(const std::array<double, 365>& days, double warmer_k, double limit_c) {
  // Linear between days, so that the season changes smoothly with its temperatures.
  double length = 0.0;
  double heat = 0.0;
  for (std::size_t d = 0; d < 365; ++d) {
    const double a = days[d] + warmer_k - limit_c;
    const double b = days[(d + 1) % 365] + warmer_k - limit_c;
    if (a <= 0.0 && b <= 0.0) continue;
    if (a > 0.0 && b > 0.0) {
      length += 1.0;
      heat += 0.5 * (a + b);
      continue;
    }
    const double top = std::max(a, b);
    const double part = top / std::abs(a - b);
    length += part;
    heat += 0.5 * top * part;
  }
  return {length, length > 0.0 ? limit_c + heat / length : 0.0};
}

}  // namespace

std::array<double, 365> daily_c(const Months& months) {
  static const DayWeights weights = make_day_weights();
  std::array<double, 365> days{};
  for (std::size_t d = 0; d < 365; ++d) {
    double sum = 0.0;
    for (std::size_t m = 0; m < 12; ++m) sum += weights[d][m] * months[m];
    days[d] = sum;
  }
  return days;
}

GrowingSeason growing_season(const Months& months, double limit_c) {
  return season_of(daily_c(months), 0.0, limit_c);
}

double treeline_excess_k(const Months& months, const TreelineParameters& parameters) {
  const std::array<double, 365> days = daily_c(months);
  double grows = 60.0;
  double does_not = -60.0;
  while (grows - does_not > 1e-6) {
    const double centre = 0.5 * (grows + does_not);
    const GrowingSeason season = season_of(days, centre, parameters.limit_c);
    (season.days >= parameters.min_days && season.mean_c >= parameters.min_mean_c ? grows
                                                                                  : does_not) =
        centre;
  }
  return grows;
}

double highest_m(const std::function<bool(double)>& holds) {
  double no = highest_line_m;
  if (holds(no)) return no;
  double yes = no;
  while (yes > lowest_line_m) {
    yes -= 100.0;
    if (holds(yes)) break;
    no = yes;
  }
  if (no <= lowest_line_m) return lowest_line_m;
  while (no - yes > 1e-3) {
    const double centre = 0.5 * (no + yes);
    (holds(centre) ? yes : no) = centre;
  }
  return yes;
}

double year_mean(const Months& months) {
  return std::accumulate(months.begin(), months.end(), 0.0) / 12.0;
}

namespace {

constexpr std::size_t trend_terms = 6;
constexpr double rain_floor_mm = 30.0;  // makes deserts with 1 and with 10 mm similar

using Site = std::array<double, 4>;

Site to_site(double longitude_deg, double latitude_deg, double altitude_km) {
  const exact::Turn longitude = exact::turn(to_radians(longitude_deg));
  const exact::Turn latitude = exact::turn(to_radians(latitude_deg));
  return {earth_radius_km * latitude.cosine * longitude.cosine,
          earth_radius_km * latitude.cosine * longitude.sine, earth_radius_km * latitude.sine,
          altitude_km};
}

double similarity_of(const ClimateSimilarity& k, const Site& a, const Site& b) {
  const double dx = a[0] - b[0];
  const double dy = a[1] - b[1];
  const double dz = a[2] - b[2];
  const double up = k.km_per_km_up * (a[3] - b[3]);
  const double way = dx * dx + dy * dy + dz * dz;
  const auto falling = [](double d2, double reach) {
    return 1.0 / (1.0 + d2 / (2.0 * reach * reach));
  };
  return k.wide * k.wide * falling(way, k.wide_km) +
         k.near * k.near * falling(way + up * up, k.near_km) +
         k.lapse_per_km * k.lapse_per_km * a[3] * b[3] * falling(way, k.lapse_km);
}

// Powers of the sine of latitude, and altitude.
std::array<double, trend_terms> trend_of(const Site& site) {
  const double s = site[2] / earth_radius_km;
  return {1.0, s, s * s, s * s * s, s * s * s * s, site[3]};
}

Cholesky factors_of_stations(Matrix matrix) {
  std::optional<Cholesky> factors = Cholesky::of(std::move(matrix));
  if (!factors)
    throw Error(ErrorKind::usage, "climate stations", "several stations at the same position",
                "one station per position");
  return *factors;
}

// Trend by generalized least squares, then weights of its residuals.
SimilarityField fit(const ClimateSimilarity& similarity, std::vector<Site> sites,
                    const std::vector<double>& values, std::size_t kinds) {
  const std::size_t n = sites.size();
  Matrix covariance(n, n), terms(n, trend_terms), measured(n, kinds);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j)
      covariance(i, j) = similarity_of(similarity, sites[i], sites[j]);
    covariance(i, i) += similarity.own * similarity.own;
    std::ranges::copy(trend_of(sites[i]), terms.row(i).begin());
    for (std::size_t c = 0; c < kinds; ++c) measured(i, c) = values[i * kinds + c];
  }
  const Cholesky factors = factors_of_stations(std::move(covariance));
  const Matrix weighted_terms = factors.solve(terms);
  const Matrix by_term = transposed(weighted_terms);
  Matrix trend = factors_of_stations(product(by_term, terms)).solve(product(by_term, measured));
  Matrix weights = factors.solve(measured);
  const Matrix explained = product(weighted_terms, trend);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t c = 0; c < kinds; ++c) weights(i, c) -= explained(i, c);
  return {similarity, std::move(sites), std::move(trend), std::move(weights)};
}

// The values at a position, of as many kinds as the field has.
std::array<double, 4> value_at(const SimilarityField& field, const Site& position) {
  const std::size_t count = field.trend.columns();
  const auto f = trend_of(position);
  std::array<double, 4> values{};
  for (std::size_t c = 0; c < count; ++c)
    for (std::size_t r = 0; r < trend_terms; ++r) values[c] += f[r] * field.trend(r, c);
  for (std::size_t i = 0; i < field.stations.size(); ++i) {
    const double k = similarity_of(field.similarity, position, field.stations[i]);
    for (std::size_t c = 0; c < count; ++c) values[c] += k * field.weights(i, c);
  }
  return values;
}

// January, April, July, October to twelve months: mean, one wave per year of any phase, and two
// waves per year with a maximum in January.
Months to_months(const std::array<double, 4>& season) {
  constexpr double half_root_3 = 0.86602540378443865;
  constexpr std::array<double, 12> cosine = {1.0,  half_root_3,  0.5,  0.0, -0.5, -half_root_3,
                                             -1.0, -half_root_3, -0.5, 0.0, 0.5,  half_root_3};
  const auto [january, april, july, october] = season;
  const double mean = 0.25 * (january + april + july + october);
  const double winter = 0.5 * (january - july);
  const double spring = 0.5 * (april - october);
  const double twice = 0.25 * (january + july - april - october);
  Months months{};
  for (std::size_t m = 0; m < 12; ++m)
    months[m] =
        mean + winter * cosine[m] + spring * cosine[(m + 9) % 12] + twice * cosine[2 * m % 12];
  return months;
}

}  // namespace

std::vector<ClimateStation> climate_stations_from_toml(const std::string& text,
                                                       const std::string& name) {
  std::vector<ClimateStation> stations;
  for_each_row(text, name,
               {"stations", "station", 10,
                "name, latitude, longitude, altitude, four temperatures, rain, its summer share"},
               [&](const ClimateRow& row) {
                 ClimateStation station;
                 station.name = row.text(0);
                 station.latitude_deg = row.number(1, -90.0, 90.0);
                 station.longitude_deg = row.number(2, -180.0, 180.0);
                 station.altitude_m = row.number(3, -450.0, 8850.0);
                 for (std::size_t k = 0; k < 4; ++k)
                   station.season_c[k] = row.number(4 + k, -80.0, 50.0);
                 station.rain_mm = row.number(8, -1.0, 15000.0);
                 station.summer_share = row.number(9, 0.0, 1.0);
                 stations.push_back(std::move(station));
               });
  return stations;
}

std::vector<ClimateStation> read_climate_stations() {
  const std::string name = "climate/stations.toml";
  return climate_stations_from_toml(std::string(embedded_file(name)), name);
}

ClimateField make_climate_field(const std::vector<ClimateStation>& stations,
                                const ClimateFieldParameters& parameters) {
  std::vector<Site> sites;
  std::vector<Site> rain_sites;
  std::vector<double> temperatures;
  std::vector<double> rains;
  for (const ClimateStation& s : stations) {
    sites.push_back(to_site(s.longitude_deg, s.latitude_deg, s.altitude_m * 1e-3));
    temperatures.insert(temperatures.end(), s.season_c.begin(), s.season_c.end());
    if (s.rain_mm < 0.0) continue;
    rain_sites.push_back(sites.back());
    rains.push_back(exact::log(s.rain_mm + rain_floor_mm));
    rains.push_back(s.summer_share);
  }
  if (rain_sites.size() < 20)
    throw Error(ErrorKind::usage, "climate stations",
                fmt::format("{} stations with rain data", rain_sites.size()), "at least 20");
  return {fit(parameters.temperature, std::move(sites), temperatures, 4),
          fit(parameters.rain, std::move(rain_sites), rains, 2)};
}

PlaceClimate place_climate(const ClimateField& field, double longitude_deg, double latitude_deg) {
  const Site ground = to_site(longitude_deg, latitude_deg, 0.0);
  const auto at = [&](const SimilarityField& kind, double altitude_km) {
    Site position = ground;
    position[3] = altitude_km;
    return value_at(kind, position);
  };
  // Lines through two altitudes near the treeline and the limit of perennial snow. Trees grow where
  // treeline_excess_k() is at most 0; only the sign is computed here, which takes one evaluation of
  // the year instead of 27.
  const TreelineParameters trees;
  const auto trees_grow = [&](double m) {
    const GrowingSeason season =
        growing_season(to_months(at(field.temperature, 1e-3 * m)), trees.limit_c);
    return season.days >= trees.min_days && season.mean_c >= trees.min_mean_c;
  };
  const double treeline_km = 1e-3 * std::clamp(highest_m(trees_grow), 0.0, 4500.0);
  const double low = treeline_km - 0.2;
  const double high = treeline_km + 1.0;
  const Months low_c = to_months(at(field.temperature, low));
  const Months high_c = to_months(at(field.temperature, high));
  PlaceClimate climate;
  for (std::size_t m = 0; m < 12; ++m) {
    climate.lapse_k_per_km[m] = (low_c[m] - high_c[m]) / (high - low);
    climate.sea_level_c[m] = low_c[m] + climate.lapse_k_per_km[m] * low;
  }
  for (std::size_t k = 0; k < climate.rain_mm_at_km.size(); ++k)
    climate.rain_mm_at_km[k] =
        std::max(0.0, exact::exp(at(field.rain, static_cast<double>(k))[0]) - rain_floor_mm);
  climate.summer_share = std::clamp(at(field.rain, treeline_km + 0.5)[1], 0.05, 0.95);
  return climate;
}

Months monthly_c(const PlaceClimate& climate, double altitude_m) {
  Months months{};
  for (std::size_t m = 0; m < 12; ++m)
    months[m] = climate.sea_level_c[m] - climate.lapse_k_per_km[m] * (1e-3 * altitude_m);
  return months;
}

double rain_mm(const PlaceClimate& climate, double altitude_m) {
  const double km =
      std::clamp(1e-3 * altitude_m, 0.0, static_cast<double>(climate.rain_mm_at_km.size() - 1));
  const std::size_t below =
      std::min(static_cast<std::size_t>(km), climate.rain_mm_at_km.size() - 2);
  const double part = km - static_cast<double>(below);
  return (1.0 - part) * climate.rain_mm_at_km[below] + part * climate.rain_mm_at_km[below + 1];
}

Months monthly_rain_mm(const PlaceClimate& climate, double altitude_m) {
  // A wave with its turn in June whose share from April to September is the given one: cosines of
  // the twelve months, and 12 over the sum of those six.
  constexpr std::array<double, 12> wave = {
      -0.96592582628906829, -0.70710678118654752, -0.25881904510252076, 0.25881904510252076,
      0.70710678118654752,  0.96592582628906829,  0.96592582628906829,  0.70710678118654752,
      0.25881904510252076,  -0.25881904510252076, -0.70710678118654752, -0.96592582628906829};
  constexpr double share_to_wave = 12.0 / 3.8637033051562732;
  const double swing = std::clamp((climate.summer_share - 0.5) * share_to_wave, -1.0, 1.0);
  const double month = rain_mm(climate, altitude_m) / 12.0;
  Months months{};
  for (std::size_t m = 0; m < 12; ++m) months[m] = month * (1.0 + swing * wave[m]);
  return months;
}

double treeline_m(const PlaceClimate& climate, double warmer_k,
                  const TreelineParameters& parameters) {
  return highest_m([&](double m) {
    Months months = monthly_c(climate, m);
    for (double& t : months) t += warmer_k;
    const GrowingSeason season = growing_season(months, parameters.limit_c);
    return season.days >= parameters.min_days && season.mean_c >= parameters.min_mean_c;
  });
}

}  // namespace belvedere
