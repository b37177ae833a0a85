#include "terrain/io/points.h"

#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/text/parse_number.h"
#include "base/text/text_encoding.h"
#include "terrain/io/crs.h"
#include "terrain/io/csv.h"
#include "terrain/io/raster_file.h"

namespace belvedere {
namespace {

constexpr const char* longitude_latitude = "EPSG:4326";

double number_of(const std::string& text, const std::string& where, const std::string& column,
                 double max) {
  const std::optional<double> value = parse_number<double>(text);
  if (!value || !(std::abs(*value) <= max))
    throw Error(ErrorKind::usage, where, fmt::format("{} is \"{}\"", column, text),
                fmt::format("a number, -{} … {}, with a decimal point", max, max));
  return *value;
}

PointTable read_csv_points(const VectorSource& source, const std::string& crs) {
  const std::string& path = source.path;
  const CsvTable csv = read_csv(path, source.encoding);
  const int longitude = csv.find_any({"lon", "longitude"});
  const int latitude = csv.find_any({"lat", "latitude"});
  const int east = csv.find_any({"east", "easting"});
  const int north = csv.find_any({"north", "northing"});
  const bool degrees = longitude >= 0 && latitude >= 0;
  if (!degrees && (east < 0 || north < 0))
    throw Error(ErrorKind::usage, path + ":1",
                fmt::format("no coordinate columns; it has {}", fmt::join(csv.columns, ", ")),
                "lon and lat, or east and north");
  if (degrees && crs.empty())
    throw Error(ErrorKind::usage, path, "has longitude and latitude, but the terrain has no CRS",
                "columns east and north");
  constexpr double farthest_m = 1e8;  // farther than around the Earth
  PointTable table{.file = path, .columns = csv.columns, .points = {}};
  std::vector<glm::dvec2> positions;
  for (const CsvTable::Row& row : csv.rows) {
    const std::string where = fmt::format("{}:{}", path, row.line);
    const auto value = [&](int column, double max) {
      const auto at = static_cast<std::size_t>(column);
      return number_of(row.fields[at], where, csv.columns[at], max);
    };
    const double x = degrees ? value(longitude, 180.0) : value(east, farthest_m);
    const double y = degrees ? value(latitude, 90.0) : value(north, farthest_m);
    positions.emplace_back(x, y);
    table.points.push_back({.where = where, .position = {}, .values = row.fields});
  }
  if (!degrees && !source.crs.empty() && crs.empty())
    throw Error(ErrorKind::usage, path, "has a `crs`, but the terrain has none",
                "columns east and north of the terrain, without `crs`");
  const std::string own = degrees ? longitude_latitude : source.crs;
  if (!own.empty()) PointTransform(own, crs).apply(positions);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!std::isfinite(positions[i].x))
      throw Error(ErrorKind::input, table.points[i].where,
                  "the position is outside the valid area of " + describe_crs(crs));
    table.points[i].position = positions[i];
  }
  return table;
}

}  // namespace

std::optional<double> PointTable::number(const Point& point, int column, double min, double max,
                                         std::string_view unit) const {
  if (column < 0 || point.values[static_cast<std::size_t>(column)].empty()) return std::nullopt;
  const std::string& text = point.values[static_cast<std::size_t>(column)];
  const std::optional<double> value = parse_number<double>(text);
  if (!value || !(*value >= min && *value <= max))
    throw Error(ErrorKind::usage, point.where,
                fmt::format("{} is \"{}\"", columns[static_cast<std::size_t>(column)], text),
                fmt::format("a number{}{}, {} … {}, or empty if unknown",
                            unit.empty() ? "" : " of ", unit, min, max));
  return value;
}

int PointTable::find(std::string_view column) const {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const std::string& c) {
    return lower_case(c) == lower_case(std::string(column));
  });
  return found == columns.end() ? -1 : static_cast<int>(found - columns.begin());
}

PointTable read_points(const VectorSource& source, const std::string& crs) {
  return lower_extension(source.path) == ".csv" ? read_csv_points(source, crs)
                                                : read_point_layer(source, crs);
}

std::vector<MapLine> read_lines(const VectorSource& source, const std::string& crs) {
  const std::string& path = source.path;
  MapFeatures file = read_map_features(source, {.also = {"name"}}, crs);
  if (file.unplaceable > 0)
    throw Error(ErrorKind::input, path,
                fmt::format("{} of its features have positions outside the valid area of {}",
                            file.unplaceable, describe_crs(crs)));
  std::vector<MapLine> lines;
  for (MapFeature& feature : file.features)
    if (feature.shape == MapShape::line)
      lines.push_back({.name = feature.values[0],
                       .where = feature.where,
                       .positions = std::move(feature.parts.front())});
  if (lines.empty()) throw Error(ErrorKind::input, path, "has no lines", "tracks, routes or lines");
  return lines;
}

}  // namespace belvedere
