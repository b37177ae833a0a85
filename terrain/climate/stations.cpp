#include "terrain/climate/stations.h"

#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"
#include "base/random.h"
#include "base/statistics.h"
#include "base/text/text_encoding.h"
#include "terrain/climate/zonal_climate.h"
#include "terrain/io/crs.h"
#include "terrain/io/points.h"
#include "terrain/io/raster_file.h"

namespace belvedere {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

// NaN if the field is empty.
double number_in(const PointTable& table, const PointTable::Point& point, int column, double min,
                 double max, const char* unit) {
  return table.number(point, column, min, max, unit).value_or(unknown);
}

int find_one_of(const PointTable& table, const std::vector<const char*>& names) {
  for (const char* name : names)
    if (const int column = table.find(name); column >= 0) return column;
  return -1;
}

StationTable from_points(const std::string& path, const std::string& crs) {
  const PointTable table = read_points(path, crs);
  const auto missing = [&](const std::string& what, const std::string& allowed) {
    throw Error(ErrorKind::usage, path,
                fmt::format("has no column {}; it has {}", what, fmt::join(table.columns, ", ")),
                allowed);
  };
  const int name = table.find("name");
  const int region = table.find("region");
  const int altitude = find_one_of(table, {"altitude_m", "altitude", "elevation", "height"});
  if (altitude < 0)
    missing("altitude_m", "altitude_m (or altitude, elevation, height): metres above sea level");
  std::array<int, 12> month{};
  std::string lacking;
  int found = 0;
  for (std::size_t m = 0; m < 12; ++m) {
    month[m] = table.find(fmt::format("t_{}", m + 1));
    if (month[m] >= 0)
      ++found;
    else
      lacking += fmt::format("{}t_{}", lacking.empty() ? "" : ", ", m + 1);
  }
  const int year = table.find("t_year");
  const int rain = find_one_of(table, {"rain_mm", "rain", "precipitation"});
  if (found > 0 && found < 12) missing(lacking, "all of t_1 … t_12, or t_year alone");
  if (found == 0 && year < 0 && rain < 0)
    missing("t_1 … t_12, t_year or rain_mm",
            "monthly temperatures, the annual mean or the annual rain");
  StationTable out{.file = path, .period = {}, .stations = {}};
  for (const PointTable::Point& point : table.points) {
    Station station;
    station.name = name < 0 ? point.where : point.values[static_cast<std::size_t>(name)];
    if (region >= 0) station.region = point.values[static_cast<std::size_t>(region)];
    station.position = point.position;
    station.altitude_m = number_in(table, point, altitude, -500.0, 9000.0, "metres");
    if (std::isnan(station.altitude_m))
      throw Error(ErrorKind::usage, point.where,
                  fmt::format("no {}", table.columns[static_cast<std::size_t>(altitude)]),
                  "the station's altitude");
    for (std::size_t m = 0; m < 12; ++m)
      station.temperature_c[m] = number_in(table, point, month[m], -90.0, 60.0, "°C");
    station.temperature_year_c = number_in(table, point, year, -90.0, 60.0, "°C");
    if (std::isnan(station.temperature_year_c))
      station.temperature_year_c = year_mean(station.temperature_c);
    station.rain_mm = number_in(table, point, rain, 0.0, 20000.0, "mm");
    out.stations.push_back(station);
  }
  return out;
}

// Months since year 0 of each time, from units such as "days since 1801-10-01".
std::vector<int> months_of(const NumberArray& time, const std::string& path) {
  int year = 0;
  int month = 0;
  int day = 0;
  char what[16] = {};
  if (std::sscanf(time.unit.c_str(), "%15s since %d-%d-%d", what, &year, &month, &day) != 4)
    throw Error(ErrorKind::input, path, fmt::format("the unit of time is \"{}\"", time.unit),
                "days, hours or months since a date: \"days since 1801-10-01\"");
  const std::string unit = what;
  const bool days = unit == "days" || unit == "day";
  const bool hours = unit == "hours" || unit == "hour";
  if (!days && !hours && unit != "months" && unit != "month")
    throw Error(ErrorKind::input, path, fmt::format("the unit of time is {}", unit),
                "days, hours or months since a date");
  const std::chrono::year_month_day first{std::chrono::year(year),
                                          std::chrono::month(static_cast<unsigned>(month)),
                                          std::chrono::day(static_cast<unsigned>(day))};
  if (!first.ok())
    throw Error(ErrorKind::input, path, fmt::format("the unit of time is \"{}\"", time.unit),
                "a valid date");
  std::vector<int> months;
  for (const double value : time.values) {
    constexpr double max_days = 1e6;
    if (!(std::abs(value) <= max_days * (hours ? 24.0 : 1.0)))
      throw Error(ErrorKind::input, path, fmt::format("time out of range: {} {}", value, unit));
    if (!days && !hours) {
      months.push_back(year * 12 + month - 1 + static_cast<int>(std::floor(value)));
      continue;
    }
    const auto passed =
        std::chrono::days(static_cast<int>(std::floor(hours ? value / 24.0 : value)));
    const std::chrono::year_month_day date{std::chrono::sys_days(first) + passed};
    months.push_back(static_cast<int>(date.year()) * 12 +
                     static_cast<int>(static_cast<unsigned>(date.month())) - 1);
  }
  return months;
}

std::string month_text(int month) { return fmt::format("{}-{:02}", month / 12, month % 12 + 1); }

constexpr int history_months = 30 * 12;

struct HistoryArrays {
  NumberArray lon, lat, hgt, time;
  std::optional<NumberArray> temp, prcp;
};

HistoryArrays read_history(const std::string& path) {
  std::vector<std::optional<NumberArray>> arrays =
      read_number_arrays(path, {"lon", "lat", "hgt", "time", "temp", "prcp"});
  constexpr std::array names = {"lon", "lat", "hgt", "time"};
  for (std::size_t i = 0; i < names.size(); ++i)
    if (!arrays[i])
      throw Error(ErrorKind::usage, path, fmt::format("has no array {}", names[i]),
                  "lon, lat, hgt (lat, lon), time, temp and prcp (time, lat, lon)");
  if (!arrays[4] && !arrays[5])
    throw Error(ErrorKind::usage, path, "has neither array temp nor array prcp",
                "at least one of them");
  HistoryArrays out{.lon = *arrays[0],
                    .lat = *arrays[1],
                    .hgt = *arrays[2],
                    .time = *arrays[3],
                    .temp = arrays[4],
                    .prcp = arrays[5]};
  const std::size_t columns = out.lon.values.size();
  const std::size_t rows = out.lat.values.size();
  const auto require = [&](const NumberArray& array, const std::vector<std::size_t>& sizes) {
    if (array.sizes != sizes)
      throw Error(
          ErrorKind::usage, path,
          fmt::format("array {} has the size {}", array.name, fmt::join(array.sizes, " × ")),
          fmt::format("{}, the sizes of lon, lat and time", fmt::join(sizes, " × ")));
  };
  require(out.hgt, {rows, columns});
  for (const auto& series : {out.temp, out.prcp})
    if (series) require(*series, {out.time.values.size(), rows, columns});
  return out;
}

StationTable from_history(const std::string& path, const std::string& crs) {
  const HistoryArrays arrays = read_history(path);
  const std::vector<int> months = months_of(arrays.time, path);
  if (months.empty()) throw Error(ErrorKind::input, path, "has no months");
  const int last = *std::max_element(months.begin(), months.end());
  const int first =
      std::max(*std::min_element(months.begin(), months.end()), last - history_months + 1);
  const std::size_t cells = arrays.hgt.values.size();
  const std::size_t columns = arrays.lon.values.size();
  // Means over the available months; the unit says whether they are in Kelvin.
  const bool kelvin = arrays.temp && (arrays.temp->unit == "K" || arrays.temp->unit == "kelvin");
  const auto mean_of_month = [&](const std::optional<NumberArray>& series, std::size_t cell,
                                 int month) {
    double sum = 0.0;
    int count = 0;
    for (std::size_t t = 0; series && t < months.size(); ++t) {
      const double value = series->values[t * cells + cell];
      if (months[t] < first || months[t] % 12 != month || std::isnan(value)) continue;
      sum += value;
      ++count;
    }
    return count > 0 ? sum / count : unknown;
  };
  StationTable out{.file = path,
                   .period = fmt::format("{} … {}", month_text(first), month_text(last)),
                   .stations = {}};
  std::vector<glm::dvec2> positions;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    if (std::isnan(arrays.hgt.values[cell])) continue;
    Station station;
    station.name =
        fmt::format("{} {}", arrays.lon.values[cell % columns], arrays.lat.values[cell / columns]);
    station.altitude_m = arrays.hgt.values[cell];
    station.rain_mm = 0.0;
    for (std::size_t m = 0; m < 12; ++m) {
      station.temperature_c[m] =
          mean_of_month(arrays.temp, cell, static_cast<int>(m)) - (kelvin ? 273.15 : 0.0);
      station.rain_mm += mean_of_month(arrays.prcp, cell, static_cast<int>(m));
    }
    station.temperature_year_c = year_mean(station.temperature_c);
    positions.emplace_back(arrays.lon.values[cell % columns], arrays.lat.values[cell / columns]);
    out.stations.push_back(station);
  }
  if (crs.empty())
    throw Error(ErrorKind::usage, path, "has longitude and latitude, but the terrain has no CRS",
                "a table with columns east and north");
  PointTransform(normalize_crs("EPSG:4326"), crs).apply(positions);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!std::isfinite(positions[i].x))
      throw Error(ErrorKind::input, path,
                  fmt::format("the cell {} is outside the valid area of {}", out.stations[i].name,
                              describe_crs(crs)));
    out.stations[i].position = positions[i];
  }
  return out;
}

bool any_of_stations(const StationTable& table, bool (*known)(const Station&)) {
  return std::any_of(table.stations.begin(), table.stations.end(), known);
}

}  // namespace

bool StationTable::has_months() const {
  return any_of_stations(*this, [](const Station& s) {
    return std::none_of(s.temperature_c.begin(), s.temperature_c.end(),
                        [](double t) { return std::isnan(t); });
  });
}
bool StationTable::has_temperature() const {
  return any_of_stations(*this, [](const Station& s) { return !std::isnan(s.temperature_year_c); });
}
bool StationTable::has_rain() const {
  return any_of_stations(*this, [](const Station& s) { return !std::isnan(s.rain_mm); });
}

StationTable read_stations(const std::string& path, const std::string& crs, Progress& progress) {
  StationTable table =
      lower_extension(path) == ".nc" ? from_history(path, crs) : from_points(path, crs);
  if (table.stations.empty())
    throw Error(ErrorKind::input, path, "has no stations",
                fmt::format("at least {} stations", fewest_stations));
  if (table.stations.size() < static_cast<std::size_t>(fewest_stations))
    progress.note(
        fmt::format("{}: {} stations are too few for a reliable lapse rate; use at least {} at "
                    "different altitudes",
                    path, table.stations.size(), fewest_stations));
  return table;
}

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

  // Cross-validation leaves out about a hundred stations in turn, however many there are.
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
