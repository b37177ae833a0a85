#include "renderer/labels/label_points.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <span>
#include <utility>

#include "base/error.h"
#include "base/filter.h"
#include "base/parallel.h"
#include "base/text/text_encoding.h"
#include "terrain/io/crs.h"
#include "terrain/io/points.h"

namespace belvedere {
namespace {

const std::string& text_of(const PointTable::Point& point, int column) {
  static const std::string nothing;
  return column < 0 ? nothing : point.values[static_cast<std::size_t>(column)];
}

// Indices of those columns in a table: layers of one file may have different ones.
std::vector<int> columns_of(const PointTable& table, std::span<const char* const> names) {
  std::vector<int> columns;
  for (const char* name : names)
    if (const int column = table.find(name); column >= 0) columns.push_back(column);
  return columns;
}

// The first of them that is not empty for a point; -1: none.
int filled(const PointTable::Point& point, const std::vector<int>& columns) {
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](int column) { return !text_of(point, column).empty(); });
  return found == columns.end() ? -1 : *found;
}

// Valid UTF-8 (RFC 3629): no overlong forms, no surrogates.
bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t k) {
      return i + k < text.size() ? static_cast<unsigned>(static_cast<unsigned char>(text[i + k]))
                                 : 0U;
    };
    const std::size_t more = byte(0) < 0x80       ? 0
                             : byte(0) >> 5 == 6  ? 1
                             : byte(0) >> 4 == 14 ? 2
                             : byte(0) >> 3 == 30 ? 3
                                                  : 9;
    if (more > 3) return false;
    unsigned letter = more == 0 ? byte(0) : byte(0) & (0x3FU >> more);
    for (std::size_t k = 1; k <= more; ++k) {
      if (byte(k) >> 6 != 2) return false;
      letter = letter << 6 | (byte(k) & 0x3FU);
    }
    constexpr std::array min{0U, 0x80U, 0x800U, 0x10000U};
    if (letter < min[more] || letter > 0x10FFFFU || (letter >= 0xD800U && letter <= 0xDFFFU))
      return false;
    i += more + 1;
  }
  return true;
}

// Rank by population: a city of a hundred thousand has rank 1, each further rank about a third of
// the inhabitants. Nothing for texts that are not numbers, as OpenStreetMap has some.
std::optional<double> rank_of_population(const std::string& text) {
  constexpr std::array from{100000.0, 30000.0, 10000.0, 3000.0, 1000.0, 300.0, 100.0, 30.0};
  double people = 0.0;
  if (std::from_chars(text.data(), text.data() + text.size(), people).ec != std::errc())
    return std::nullopt;
  return 1.0 + static_cast<double>(std::count_if(from.begin(), from.end(),
                                                 [&](double least) { return people < least; }));
}

constexpr std::array kind_columns{"kind", "type", "natural", "place", "tourism"};
constexpr std::array by_hand_columns{"dx_mm", "dy_mm"};
constexpr std::array altitude_columns{"ele", "altitude_m", "altitude", "elevation", "height"};

// The points of a file of any format, for vector files those of all its layers.
PointTable read_table(const VectorSource& source, const std::string& crs, NamesAre names,
                      Progress& progress) {
  const std::string& path = source.path;
  if (lower_extension(path) == ".csv" || crs.empty()) return read_points(source, crs);
  MapQuery query;
  (names == NamesAre::needed ? query.columns : query.also).emplace_back("name");
  query.also.insert(query.also.end(), kind_columns.begin(), kind_columns.end());
  query.also.emplace_back("rank");
  query.also.emplace_back("population");
  query.also.insert(query.also.end(), altitude_columns.begin(), altitude_columns.end());
  query.also.insert(query.also.end(), by_hand_columns.begin(), by_hand_columns.end());
  MapFeatures file = read_map_features(source, query, crs);
  PointTable table{.file = path, .columns = {"name"}, .points = {}};
  table.columns.insert(table.columns.end(), kind_columns.begin(), kind_columns.end());
  table.columns.emplace_back("rank");
  table.columns.emplace_back("population");
  table.columns.insert(table.columns.end(), altitude_columns.begin(), altitude_columns.end());
  table.columns.insert(table.columns.end(), by_hand_columns.begin(), by_hand_columns.end());
  for (MapFeature& feature : file.features)
    if (feature.shape == MapShape::point)
      table.points.push_back({.where = feature.where,
                              .position = feature.parts.front().front(),
                              .values = std::move(feature.values)});
  if (file.unplaceable > 0)
    progress.note(fmt::format("{}: {} features outside {} are left out", path, file.unplaceable,
                              describe_crs(crs)));
  if (table.points.empty())
    throw Error(ErrorKind::input, path, "no points in it",
                "points; lines and areas with names are --shapes, or [[labels.shapes]]");
  return table;
}

}  // namespace

// Continuation bytes do not count.
std::size_t letters_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::vector<LabelPoint> read_label_points(const VectorSource& source, const std::string& crs,
                                          const LabelStyle& style, Progress& progress,
                                          NamesAre names) {
  const std::string& path = source.path;
  const bool all = names == NamesAre::optional;
  const PointTable table = read_table(source, crs, names, progress);
  const int name = table.find("name");
  if (name < 0 && !all)
    throw Error(ErrorKind::usage, path,
                fmt::format("no column of names; there are {}", fmt::join(table.columns, ", ")),
                "name");
  const std::vector<int> kind = columns_of(table, kind_columns);
  const int rank = table.find("rank");
  const int population = table.find("population");
  const std::vector<int> altitude = columns_of(table, altitude_columns);
  const int dx_mm = table.find(by_hand_columns[0]);
  const int dy_mm = table.find(by_hand_columns[1]);
  std::vector<LabelPoint> points;
  std::size_t unnamed = 0;
  std::size_t too_long = 0;
  std::set<std::string> strange;
  for (const PointTable::Point& row : table.points) {
    LabelPoint point;
    point.name = text_of(row, name);
    point.position = row.position;
    point.where = row.where;
    if (point.name.empty() && !all) {
      ++unnamed;
      continue;
    }
    if (letters_of(point.name) > longest_name && !all) {
      ++too_long;
      continue;
    }
    if (!is_utf8(point.name))
      throw Error(ErrorKind::input, row.where, "the name is not valid UTF-8",
                  "a file that is saved as UTF-8");
    if (const std::string& word = text_of(row, filled(row, kind)); !word.empty()) {
      const int found = style.find(word);
      if (found < 0) strange.insert(word);
      point.kind = std::max(0, found);
    }
    point.rank = table.number(row, rank, 1.0, 9.0)
                     .value_or(rank_of_population(text_of(row, population)).value_or(point.rank));
    point.altitude_m = table.number(row, filled(row, altitude), -12000.0, 9000.0);
    const std::optional<double> dx = table.number(row, dx_mm, -1000.0, 1000.0);
    const std::optional<double> dy = table.number(row, dy_mm, -1000.0, 1000.0);
    if (dx || dy) point.by_hand_mm = {dx.value_or(0.0), dy.value_or(0.0)};
    points.push_back(std::move(point));
  }
  if (points.empty() && !table.points.empty())
    throw Error(ErrorKind::usage, path,
                fmt::format("none of its {} points has a name of 1 … {} letters",
                            table.points.size(), longest_name),
                "names that fit in a panorama, in the column name");
  if (unnamed > 0)
    progress.note(fmt::format("{}: {} of {} points have no name and are left out", path, unnamed,
                              table.points.size()));
  if (too_long > 0)
    progress.note(fmt::format(
        "{}: {} names of more than {} letters are left out: they do not fit in a panorama", path,
        too_long, longest_name));
  if (!strange.empty() && !all)
    progress.note(
        fmt::format("{}: {} points of kinds that the style {} does not contain: set as {}", path,
                    strange.size() == 1 ? "a kind" : fmt::format("{} kinds", strange.size()),
                    style.name, style.kinds[0].name) +
        fmt::format(" ({})", fmt::join(strange, ", ")));
  return points;
}

std::vector<LabelPoint> unnamed_summits(const std::vector<Summit>& summits,
                                        const GeoTransform& transform, double cell_m,
                                        const std::vector<LabelPoint>& named,
                                        const LabelStyle& style) {
  const int kind = std::max(0, style.find("summit"));
  // Summit positions in files are up to some hundred metres off, and so are those of a coarse DEM.
  const double same_m = std::max(style.kinds[static_cast<std::size_t>(kind)].climb_m, 2.0 * cell_m);
  const double metres = cell_m / transform.cell_x;
  std::vector<LabelPoint> points;
  for (const Summit& summit : summits) {
    const glm::dvec2 position = transform.to_crs(summit.x, summit.y);
    const bool known = std::any_of(named.begin(), named.end(), [&](const LabelPoint& point) {
      return point.kind == kind && glm::length(point.position - position) * metres <= same_m;
    });
    if (known) continue;
    const double rank =
        std::clamp(9.0 - static_cast<double>(summit.prominence_m) / 400.0, 6.0, 9.0);
    points.push_back({.name = {},
                      .kind = kind,
                      .rank = rank,
                      .altitude_m = std::nullopt,
                      .position = position,
                      .where = fmt::format("summit of the DEM, {:.0f} m above its saddle",
                                           summit.prominence_m)});
  }
  return points;
}

namespace {

// How far above a mark sky must be visible for it to be on the skyline, px: a summit's own vertices
// lie on the line itself.
constexpr double sky_over_px = 1.5;
// Radius of the search for higher ground: boulders of a fine DEM are not summits.
constexpr int step_cells = 3;

// A cell with its position in the picture.
struct SeenCell {
  glm::ivec2 cell{0};
  ImagePosition at;
};

// The upper edge of a summit as drawn. Seen from high above, ground behind the top may still be
// drawn above it: from the top one goes to the highest visible position in the picture among the
// nearest cells, while the ground falls. Where it rises again, or the path leaves the search
// radius, the slope belongs to the ground behind, and the edge is the top itself.
ImagePosition upper_edge(const LocatedGround& ground, glm::dvec2 start, glm::dvec2 top,
                         const ImagePosition& seen_top, double max_m) {
  const Grid<float>& z = ground.generalized_m;
  const glm::dvec2 from = ground.transform.to_cell(top.x, top.y);
  SeenCell here{{static_cast<int>(std::lround(from.x)), static_cast<int>(std::lround(from.y))},
                seen_top};
  while (true) {
    SeenCell next = here;
    for (int dy = -step_cells; dy <= step_cells; ++dy)
      for (int dx = -step_cells; dx <= step_cells; ++dx) {
        const glm::ivec2 cell = here.cell + glm::ivec2(dx, dy);
        if (!z.contains(cell.x, cell.y)) continue;
        const std::optional<ImagePosition> at =
            ground.map.drawn_to_image(ground.transform.to_crs(cell.x, cell.y));
        if (at && at->visible && at->pixel.y < next.at.pixel.y) next = {cell, *at};
      }
    if (next.cell == here.cell) return here.at;
    const bool rises = z(next.cell.x, next.cell.y) > z(here.cell.x, here.cell.y);
    if (rises || glm::length(ground.transform.to_crs(next.cell.x, next.cell.y) - start) > max_m)
      return seen_top;
    here = next;
  }
}

LabelMark find_mark(const LocatedGround& ground, const LabelPoint& point,
                    const LabelKindStyle& kind) {
  LabelMark mark;
  mark.drawn_position = point.position;
  mark.dem_altitude_m = NAN;
  const glm::dvec2 start = ground.map.drawn_position(point.position);
  const std::optional<glm::dvec2> drawn =
      kind.climb_m > 0.0 ? climb(ground, start, kind.climb_m) : std::optional<glm::dvec2>(start);
  if (!drawn) return mark;
  const glm::dvec2 position = ground.map.position_of_drawn(*drawn);
  if (!ground.map.on_surface(position)) return mark;
  mark.drawn_position = position;
  const glm::dvec2 cell = ground.transform.to_cell(position.x, position.y);
  // Between cells as in the profiles of tracks; at the centre of a cell, as of a top, its own
  // value.
  mark.dem_altitude_m = static_cast<double>(sample_bilinear(ground.altitude_m, cell.x, cell.y));
  std::optional<ImagePosition> at = ground.map.drawn_to_image(*drawn);
  if (!at) {
    mark.state = MarkState::behind_eye;
    return mark;
  }
  if (kind.climb_m > 0.0 && at->visible) at = upper_edge(ground, start, *drawn, *at, kind.climb_m);
  mark.pixel = at->pixel;
  mark.distance_m = at->distance_m;
  mark.state = at->visible      ? MarkState::seen
               : at->in_picture ? MarkState::hidden
                                : MarkState::outside_picture;
  if (mark.state == MarkState::hidden) mark.in_front = ground.map.to_geo(at->pixel);
  if (mark.state == MarkState::seen)
    mark.on_skyline = !ground.map.to_geo(at->pixel - glm::dvec2(0.0, sky_over_px));
  return mark;
}

}  // namespace

std::string_view name_of(MarkState state) {
  constexpr std::array names{"seen", "hidden behind ground", "outside the picture",
                             "behind the eye", "outside the terrain"};
  return names[static_cast<std::size_t>(state)];
}

std::optional<glm::dvec2> climb(const LocatedGround& ground, glm::dvec2 position, double max_m) {
  const Grid<float>& z = ground.generalized_m;
  const glm::dvec2 start = ground.transform.to_cell(position.x, position.y);
  int x = static_cast<int>(std::lround(start.x));
  int y = static_cast<int>(std::lround(start.y));
  if (!z.contains(x, y)) return std::nullopt;
  while (true) {
    int to_x = x;
    int to_y = y;
    for (int dy = -step_cells; dy <= step_cells; ++dy)
      for (int dx = -step_cells; dx <= step_cells; ++dx)
        if (z.contains(x + dx, y + dy) && z(x + dx, y + dy) > z(to_x, to_y)) {
          to_x = x + dx;
          to_y = y + dy;
        }
    const bool is_top = to_x == x && to_y == y;
    if (is_top) return ground.transform.to_crs(x, y);
    // A slope that continues beyond the search radius is not the summit of this name: the point
    // then stays where its file has it.
    if (glm::length(glm::dvec2(to_x, to_y) - start) * ground.cell_m > max_m) return position;
    x = to_x;
    y = to_y;
  }
}

std::vector<LabelMark> find_marks(const LocatedGround& ground,
                                  const std::vector<LabelPoint>& points, const LabelStyle& style) {
  std::vector<LabelMark> marks(points.size());
  parallel_ranges<std::size_t>(points.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      marks[i] =
          find_mark(ground, points[i], style.kinds[static_cast<std::size_t>(points[i].kind)]);
  });
  return marks;
}

}  // namespace belvedere
