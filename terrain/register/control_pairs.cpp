#include "terrain/register/control_pairs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/error.h"
#include "base/filter.h"
#include "base/text/parse_number.h"
#include "terrain/io/crs.h"
#include "terrain/io/csv.h"

namespace belvedere {
namespace {

struct PairColumns {
  int x, y, longitude, latitude, name, sure;  // sure: -1 if there is none
};

constexpr std::array<std::string_view, 6> written = {"x_px", "y_px", "lon", "lat", "name", "sure"};

PairColumns pair_columns(const CsvTable& table, const ControlPairsFormat& format) {
  for (std::size_t i = 0; !format.other_columns && i < table.columns.size(); ++i)
    if (std::none_of(written.begin(), written.end(), [&](std::string_view name) {
          return table.find(name) == static_cast<int>(i);
        }))
      throw Error(ErrorKind::usage, table.name + ":1",
                  fmt::format("has a column {}, which would be lost", table.columns[i]),
                  fmt::format("{} alone", fmt::join(written, ", ")));
  const auto column = [&](const char* name) {
    const int found = table.find(name);
    if (found < 0)
      throw Error(ErrorKind::usage, table.name + ":1",
                  fmt::format("no column {}; it has {}", name, fmt::join(table.columns, ", ")),
                  "x_px, y_px, lon, lat, name, and optionally sure");
    return found;
  };
  return {column("x_px"), column("y_px"), column("lon"),
          column("lat"),  column("name"), table.find("sure")};
}

// Reads one row; errors name its line and column.
class PairRow {
 public:
  PairRow(const CsvTable& table, const CsvTable::Row& row) : table_(table), row_(row) {}

  const std::string& text(int column) const {
    return row_.fields[static_cast<std::size_t>(column)];
  }
  double number(int column, double min, double max) const {
    const std::string& field = text(column);
    const std::optional<double> value = parse_number<double>(field);
    if (!value || !(*value >= min && *value <= max))
      refuse(column, fmt::format("\"{}\"", field),
             fmt::format("a number, {} … {}, with a decimal point", min, max));
    return *value;
  }
  bool sure(int column) const {
    if (column < 0 || text(column).empty() || text(column) == "0") return false;
    if (text(column) != "1")
      refuse(column, fmt::format("\"{}\"", text(column)), "1, or 0 or empty if not sure");
    return true;
  }
  [[noreturn]] void refuse(int column, const std::string& found, const std::string& allowed) const {
    throw Error(ErrorKind::usage, fmt::format("{}:{}", table_.name, row_.line),
                fmt::format("{} is {}", table_.columns[static_cast<std::size_t>(column)], found),
                allowed);
  }

 private:
  const CsvTable& table_;
  const CsvTable::Row& row_;
};

double altitude_of_pair(const Dem& dem, glm::dvec2 position, const PairRow& row, int column) {
  const glm::dvec2 cell = dem.transform.to_cell(position.x, position.y);
  if (!(cell.x >= 0.0 && cell.y >= 0.0 && cell.x <= dem.width() - 1.0 &&
        cell.y <= dem.height() - 1.0))
    row.refuse(column, row.text(column) + ", which lies outside the DEM",
               "a place within it; longitude before latitude");
  const int x = static_cast<int>(std::lround(cell.x));
  const int y = static_cast<int>(std::lround(cell.y));
  if (!dem.filled.empty() && dem.filled(x, y) != 0)
    row.refuse(column, row.text(column) + ", where the DEM has no data", "a place with data");
  return static_cast<double>(sample_bilinear(dem.altitude_m, cell.x, cell.y));
}

void refuse_duplicate(std::span<const ControlPair> pairs, const ControlPair& pair,
                      const PairRow& row, int column) {
  for (const ControlPair& other : pairs)
    if (other.pixel == pair.pixel && other.position == pair.position)
      row.refuse(column,
                 fmt::format("{}, as in line {}: the same pair", row.text(column), other.line),
                 "each pair once");
}

std::vector<ControlPair> pairs_of(const CsvTable& table, glm::ivec2 painting_px, const Dem& dem,
                                  const ControlPairsFormat& format) {
  if (dem.crs.empty())
    throw Error(ErrorKind::usage, table.name,
                "has longitudes and latitudes, but the DEM has no CRS", "a DEM with a CRS");
  const PairColumns columns = pair_columns(table, format);
  std::vector<ControlPair> pairs;
  std::vector<glm::dvec2> positions;
  for (const CsvTable::Row& fields : table.rows) {
    const PairRow row(table, fields);
    ControlPair& pair = pairs.emplace_back();
    pair.line = fields.line;
    pair.lonlat = {row.number(columns.longitude, -180.0, 180.0),
                   row.number(columns.latitude, -90.0, 90.0)};
    positions.push_back(pair.lonlat);
  }
  PointTransform(normalize_crs("EPSG:4326"), dem.crs).apply(positions);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const PairRow row(table, table.rows[i]);
    ControlPair& pair = pairs[i];
    pair.pixel = {row.number(columns.x, 0.0, painting_px.x),
                  row.number(columns.y, 0.0, painting_px.y)};
    pair.position = positions[i];
    pair.altitude_m = altitude_of_pair(dem, pair.position, row, columns.longitude);
    pair.name = row.text(columns.name);
    pair.sure = row.sure(columns.sure);
    refuse_duplicate(std::span(pairs).first(i), pair, row, columns.x);
  }
  if (pairs.size() < format.min_pairs)
    throw Error(ErrorKind::usage, table.name, fmt::format("{} pairs", pairs.size()),
                fmt::format("{} or more, spread over the painting; 40 are good", format.min_pairs));
  return pairs;
}

// RFC 4180.
std::string csv_field(const std::string& text) {
  const bool blank_ends = !text.empty() && (text.front() == ' ' || text.back() == ' ');
  if (!blank_ends && text.find_first_of(",;\t\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

}  // namespace

std::vector<ControlPair> read_control_pairs(const std::string& path, glm::ivec2 painting_px,
                                            const Dem& dem) {
  return pairs_of(read_csv(path), painting_px, dem, {});
}

std::vector<ControlPair> parse_control_pairs(const std::string& text, const std::string& name,
                                             glm::ivec2 painting_px, const Dem& dem,
                                             const ControlPairsFormat& format) {
  return pairs_of(parse_csv(text, name), painting_px, dem, format);
}

std::string control_pairs_text(std::span<const ControlPair> pairs) {
  std::string out = fmt::format("{}\n", fmt::join(written, ","));
  for (const ControlPair& pair : pairs)
    out += fmt::format("{},{},{},{},{},{}\n", pair.pixel.x, pair.pixel.y, pair.lonlat.x,
                       pair.lonlat.y, csv_field(pair.name), pair.sure ? "1" : "");
  return out;
}

Dem highest_cells(const Dem& dem, std::size_t max_cells) {
  int n = 1;
  const auto cells = [&] {
    return static_cast<std::size_t>(dem.width() / n) * static_cast<std::size_t>(dem.height() / n);
  };
  while (cells() > max_cells) ++n;
  if (n == 1) return dem;
  Dem out;
  out.crs = dem.crs;
  out.transform = dem.transform;
  out.transform.cell_x *= n;
  out.transform.cell_y *= n;
  out.altitude_m = Grid<float>(dem.width() / n, dem.height() / n);
  out.filled = Grid<std::uint8_t>(dem.width() / n, dem.height() / n);
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      float highest = dem.altitude_m(n * x, n * y);
      bool filled = true;
      for (int dy = 0; dy < n; ++dy)
        for (int dx = 0; dx < n; ++dx) {
          highest = std::max(highest, dem.altitude_m(n * x + dx, n * y + dy));
          filled = filled && !dem.filled.empty() && dem.filled(n * x + dx, n * y + dy) != 0;
        }
      out.altitude_m(x, y) = highest;
      out.filled(x, y) = filled ? 1 : 0;
    }
  return out;
}

}  // namespace belvedere
