#include "renderer/labels/label_points.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <string_view>

#include "base/error.h"
#include "terrain/io/points.h"

namespace belvedere {
namespace {

int find_any(const PointTable& table, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names)
    if (const int column = table.find(name); column >= 0) return column;
  return -1;
}

const std::string& text_of(const PointTable::Point& point, int column) {
  static const std::string nothing;
  return column < 0 ? nothing : point.values[static_cast<std::size_t>(column)];
}

std::optional<double> number_of(const PointTable& table, const PointTable::Point& point, int column, double least, double most) {
  const std::string& text = text_of(point, column);
  if (text.empty()) return std::nullopt;
  double value = 0.0;
  const auto [stop, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || stop != text.data() + text.size() || !(value >= least && value <= most))
    throw Error(ErrorKind::usage, point.where, fmt::format("{} is \"{}\"", table.columns[static_cast<std::size_t>(column)], text),
                fmt::format("a number, {:g} … {:g}; empty where it is not known", least, most));
  return value;
}

}  // namespace

// Bytes that begin one.
std::size_t letters_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::vector<LabelPoint> read_label_points(const std::string& path, const std::string& crs, const LabelStyle& style, Progress& progress) {
  const PointTable table = read_points(path, crs);
  const int name = table.find("name");
  if (name < 0)
    throw Error(ErrorKind::usage, path, fmt::format("no column of names; there are {}", fmt::join(table.columns, ", ")), "name");
  const int kind = find_any(table, {"kind", "type", "natural", "place", "tourism"});
  const int rank = table.find("rank");
  const int altitude = find_any(table, {"ele", "altitude_m", "altitude", "elevation", "height"});
  std::vector<LabelPoint> points;
  std::size_t unnamed = 0;
  std::size_t too_long = 0;
  std::set<std::string> strange;
  for (const PointTable::Point& row : table.points) {
    LabelPoint point;
    point.name = text_of(row, name);
    point.place = row.place;
    point.where = row.where;
    if (point.name.empty()) {
      ++unnamed;
      continue;
    }
    if (letters_of(point.name) > longest_name) {
      ++too_long;
      continue;
    }
    if (const std::string& word = text_of(row, kind); !word.empty()) {
      const int found = style.find(word);
      if (found < 0) strange.insert(word);
      point.kind = std::max(0, found);
    }
    point.rank = number_of(table, row, rank, 1.0, 9.0).value_or(point.rank);
    point.altitude_m = number_of(table, row, altitude, -12000.0, 9000.0);
    points.push_back(std::move(point));
  }
  if (unnamed > 0) progress.note(fmt::format("{}: {} of {} points have no name and are left out", path, unnamed, table.points.size()));
  if (too_long > 0)
    progress.note(
        fmt::format("{}: {} names of more than {} letters are left out: a panorama has no room for them", path, too_long, longest_name));
  if (!strange.empty())
    progress.note(fmt::format("{}: {} of which the style {} knows nothing: set as {}", path,
                              strange.size() == 1 ? "a kind" : fmt::format("{} kinds", strange.size()), style.name, style.kinds[0].name) +
                  fmt::format(" ({})", fmt::join(strange, ", ")));
  return points;
}

std::vector<LabelPoint> unnamed_summits(const std::vector<Summit>& summits, const GeoTransform& transform, double cell_m,
                                        const std::vector<LabelPoint>& named, const LabelStyle& style) {
  const int kind = std::max(0, style.find("summit"));
  // A file's place of a summit is some hundred metres off at worst, and so is a coarse DEM's.
  const double same_m = std::max(style.kinds[static_cast<std::size_t>(kind)].climb_m, 2.0 * cell_m);
  const double metres = cell_m / transform.cell_x;
  std::vector<LabelPoint> points;
  for (const Summit& summit : summits) {
    const glm::dvec2 place = transform.to_crs(summit.x, summit.y);
    const bool known = std::any_of(named.begin(), named.end(), [&](const LabelPoint& point) {
      return point.kind == kind && glm::length(point.place - place) * metres <= same_m;
    });
    if (known) continue;
    const double rank = std::clamp(9.0 - static_cast<double>(summit.prominence_m) / 400.0, 6.0, 9.0);
    points.push_back({.name = {},
                      .kind = kind,
                      .rank = rank,
                      .altitude_m = std::nullopt,
                      .place = place,
                      .where = fmt::format("summit of the DEM, {:.0f} m over its saddle", summit.prominence_m)});
  }
  return points;
}

}  // namespace belvedere
