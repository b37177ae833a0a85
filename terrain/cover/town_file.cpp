#include "terrain/cover/town_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "terrain/io/points.h"

namespace belvedere {
namespace {

// A size in a column, 0 if the field is empty.
double size_of(const PointTable& table, const PointTable::Point& point, int column) {
  if (column < 0) return 0.0;
  const std::string& text = point.values[static_cast<std::size_t>(column)];
  if (text.empty()) return 0.0;
  double value = 0.0;
  const auto [stop, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || stop != text.data() + text.size() || !(value >= 0.0) ||
      !std::isfinite(value))
    throw Error(ErrorKind::usage, point.where,
                fmt::format("{} is \"{}\"", table.columns[static_cast<std::size_t>(column)], text),
                "a number, 0 or more, or empty if unknown");
  return value;
}

}  // namespace

double town_radius_m(double population) {
  constexpr double m2_a_head = 170.0;
  return std::sqrt(population * m2_a_head / std::numbers::pi);
}

std::vector<KnownTown> read_towns(const VectorSource& source, const std::string& crs,
                                  Progress& progress) {
  const std::string& path = source.path;
  const PointTable table = read_points(source, crs);
  const int name = table.find("name");
  const int radius = table.find("radius_m");
  const int population = table.find("population");
  if (radius < 0 && population < 0)
    throw Error(ErrorKind::usage, path,
                fmt::format("no column with the size of towns; the columns are {}",
                            fmt::join(table.columns, ", ")),
                "radius_m or population");
  std::vector<KnownTown> towns;
  for (const PointTable::Point& point : table.points) {
    double radius_m = size_of(table, point, radius);
    if (radius_m == 0.0) radius_m = town_radius_m(size_of(table, point, population));
    if (radius_m > largest_town_radius_m)
      throw Error(ErrorKind::usage, point.where, fmt::format("town radius of {:.0f} m", radius_m),
                  fmt::format("at most {} m", largest_town_radius_m));
    if (radius_m > 0.0)
      towns.push_back(
          {.position = point.position,
           .radius_m = radius_m,
           .name = name < 0 ? std::string() : point.values[static_cast<std::size_t>(name)]});
  }
  if (towns.size() < table.points.size())
    progress.note(
        fmt::format("{}: {} of {} towns have neither radius_m nor population and are left out",
                    path, table.points.size() - towns.size(), table.points.size()));
  return towns;
}

}  // namespace belvedere
