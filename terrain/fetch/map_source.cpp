#include "terrain/fetch/map_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "base/config.h"
#include "base/error.h"
#include "base/text/config_reader.h"
#include "base/text/embedded.h"
#include "terrain/io/crs.h"
#include "terrain/io/http_access.h"

namespace belvedere {
namespace {

// A text that must be there.
std::string text_of(const ConfigValue& table, const char* key, const std::string& name,
                    const char* meaning) {
  const ConfigValue& value = required(table, key, name, meaning);
  if (as_string(value, name).empty())
    refuse_value(value, name, fmt::format("{} is empty", key), meaning);
  return as_string(value, name);
}

// The index of a word in a list.
int choice_of(const ConfigValue& table, const char* key, const std::string& name,
              const std::vector<std::string>& words) {
  const std::string allowed = fmt::format("\"{}\"", fmt::join(words, "\", \""));
  const ConfigValue& value = required(table, key, name, allowed);
  const auto found = std::find(words.begin(), words.end(), as_string(value, name));
  if (found == words.end())
    refuse_value(value, name, fmt::format("{} is {}", key, describe(value)), allowed);
  return static_cast<int>(found - words.begin());
}

glm::dvec2 pair_of(const ConfigValue& value, const std::string& name, double min, double max) {
  const std::vector<double> both = as_numbers(value, name, 2, min, max);
  return {both[0], both[1]};
}

bool divides(double part, double whole) {
  return std::abs(whole / part - std::round(whole / part)) < 1e-9;
}

// A field of an address: {lat}, or {lat:3} for three digits.
struct Field {
  std::string name;
  std::optional<int> digits;
  std::size_t begin = 0, end = 0;
};

// The next field from a position on; nothing if there is none. An unclosed brace has an empty name.
std::optional<Field> next_field(const std::string& url, std::size_t from) {
  const std::size_t begin = url.find('{', from);
  if (begin == std::string::npos) return std::nullopt;
  const std::size_t end = url.find('}', begin);
  if (end == std::string::npos) return Field{{}, {}, begin, url.size()};
  Field field{url.substr(begin + 1, end - begin - 1), {}, begin, end + 1};
  if (const std::size_t colon = field.name.find(':'); colon != std::string::npos) {
    const std::string digits = field.name.substr(colon + 1);
    const bool good = digits.size() == 1 && digits[0] >= '1' && digits[0] <= '9';
    field.name = good ? field.name.substr(0, colon) : std::string();
    if (good) field.digits = digits[0] - '0';
  }
  return field;
}

void check_url(const ConfigValue& value, const std::string& name) {
  const std::string& url = as_string(value, name);
  const char* const allowed =
      "https://SERVER/…{lat}…{lon}….tif, or with {row} and {column}; {lat:3} for three digits";
  if (!is_address(url)) refuse_value(value, name, "url is not a valid URL", allowed);
  std::vector<std::string> names;
  for (std::optional<Field> field = next_field(url, 0); field;
       field = next_field(url, field->end)) {
    const std::vector<std::string> known = {"lat", "lon", "row", "column"};
    if (std::find(known.begin(), known.end(), field->name) == known.end())
      refuse_value(value, name,
                   fmt::format("url contains the unknown field {}",
                               url.substr(field->begin, field->end - field->begin)),
                   allowed);
    names.push_back(field->name);
  }
  const auto has = [&](const char* field) {
    return std::find(names.begin(), names.end(), field) != names.end();
  };
  if (!(has("lat") && has("lon")) && !(has("row") && has("column")))
    refuse_value(value, name, "url is the same for all tiles", allowed);
  const std::size_t server = url.find("//") + 2;
  if (url.find('{') < url.find('/', server))
    refuse_value(value, name, "url has a field in the host name", allowed);
  check_address(url);
}

void read_grid(MapSource& source, const ConfigValue& value, const std::string& name) {
  const ConfigTable& table = as_table(value, name);
  allow_only(table, {"crs", "tile_deg", "origin_deg", "latitudes", "rows", "columns", "cells"},
             name);
  const char* const degrees = "a geographic coordinate system such as \"EPSG:4326\"";
  source.crs = text_of(value, "crs", name, degrees);
  try {
    if (!crs_traits(source.crs).geographic)
      refuse_value(*find(table, "crs"), name, "grid.crs is not in degrees", degrees);
  } catch (const Error& error) {
    refuse_value(*find(table, "crs"), name, "grid.crs: " + error.found(), error.allowed());
  }
  const ConfigValue& tile = required(value, "tile_deg", name, "width and height of tiles, degrees");
  source.tile_deg = pair_of(tile, name, 0.001, 180.0);
  if (!divides(source.tile_deg.x, 360.0) || !divides(source.tile_deg.y, 180.0))
    refuse_value(tile, name,
                 fmt::format("tiles of {}° × {}°", source.tile_deg.x, source.tile_deg.y),
                 "widths that divide 360°, heights that divide 180°");
  if (const ConfigValue* origin = find(table, "origin_deg")) {
    source.origin_deg = pair_of(*origin, name, -180.0, 180.0);
    if (source.origin_deg.y > 90.0 || !divides(source.tile_deg.y, 90.0 - source.origin_deg.y))
      refuse_value(*origin, name, fmt::format("a first row from {}° N", source.origin_deg.y),
                   "90, or a whole number of tiles south of it");
  }
  if (const ConfigValue* latitudes = find(table, "latitudes")) {
    const glm::dvec2 found = pair_of(*latitudes, name, -90.0, 90.0);
    if (!(found.x < found.y))
      refuse_value(*latitudes, name, "the first latitude is not south of the second",
                   "the southernmost, then the northernmost");
    source.latitudes = {found.x, found.y};
  }
  constexpr double max_cells = 100000.0;
  const ConfigValue& rows =
      required(value, "rows", name, "the number of cells of a tile from north to south");
  as_number(rows, name, 1.0, max_cells);
  source.rows = static_cast<int>(as_integer(rows, name));
  const ConfigValue& columns = required(
      value, "columns", name,
      "[latitude, number of cells from west to east] rows, such as [[0, 3600], [50, 2400]]");
  for (const ConfigValue& step : as_array(columns, name)) {
    const ConfigArray& both = as_array(step, name);
    if (both.size() != 2)
      refuse_value(step, name, fmt::format("grid.columns has a row of {} numbers", both.size()),
                   "[latitude, cells]");
    const double from = as_number(both[0], name, 0.0, 90.0);
    as_number(both[1], name, 1.0, max_cells);
    if (source.columns.empty() ? from != 0.0 : from <= source.columns.back().from_latitude)
      refuse_value(both[0], name, fmt::format("grid.columns has the latitude {}°", from),
                   "latitudes in ascending order from 0");
    source.columns.push_back({from, static_cast<int>(as_integer(both[1], name))});
  }
  if (source.columns.empty()) refuse_value(columns, name, "grid.columns is empty", "[[0, 3600]]");
  source.on_lines = choice_of(value, "cells", name, {"on the lines", "between the lines"}) == 0;
}

MapSource source_of(const ConfigValue& root, const std::string& name) {
  const ConfigTable& table = as_table(root, name);
  allow_only(table,
             {"name", "kind", "url", "date", "legend", "cell_m", "missing", "sea_value", "get_from",
              "credit", "licence", "grid"},
             name);
  const auto text = [&](const char* key, const char* meaning) {
    return text_of(root, key, name, meaning);
  };
  MapSource source;
  source.id = std::filesystem::path(name).stem().string();
  source.name = text("name", "the name of the source");
  const bool cover = choice_of(root, "kind", name, {"elevation", "land_cover"}) == 1;
  source.kind = cover ? MapSourceKind::land_cover : MapSourceKind::elevation;
  source.url = text("url", "https://SERVER/…{lat}…{lon}….tif");
  check_url(*find(table, "url"), name);
  source.cell_m = as_number(required(root, "cell_m", name, "metres"), name, 0.1, 10000.0);
  source.missing =
      static_cast<MissingTile>(choice_of(root, "missing", name, {"sea", "nothing", "error"}));
  if (source.missing == MissingTile::sea)
    source.sea_value =
        as_number(required(root, "sea_value", name, cover ? "the code of water" : "0"), name,
                  cover ? 0.0 : -12000.0, cover ? 65535.0 : 9000.0);
  else if (const ConfigValue* stray = find(table, "sea_value"))
    refuse_value(*stray, name, "sea_value without missing = \"sea\"", "missing = \"sea\"");
  if (cover)
    source.legend = text("legend", "a built-in legend or a file, as for a scene's land cover");
  else if (const ConfigValue* stray = find(table, "legend"))
    refuse_value(*stray, name, "legend for an elevation source", "kind = \"land_cover\"");
  ConfigReader read(root, name);
  read.text("date", source.date);
  read.text("get_from", source.get_from);
  source.credit = text("credit", "the attribution that pictures must show");
  source.licence = text("licence", "the terms of use of the data");
  read_grid(source, required(root, "grid", name, "a table [grid] with the positions of tiles"),
            name);
  return source;
}

}  // namespace

MapSource parse_map_source(const std::string& text, const std::string& name) {
  return source_of(parse_config(text, name), name);
}

std::vector<std::string> built_in_map_sources() { return embedded_names("sources"); }

MapSource read_map_source(const std::string& name_or_path) {
  const NamedConfig read = read_named_config("sources", name_or_path, "source");
  return source_of(read.root, read.name);
}

glm::dvec2 tile_corner(const MapSource& source, MapTile tile) {
  const double west = source.origin_deg.x + tile.column * source.tile_deg.x;
  return {west - 360.0 * std::floor((west + 180.0) / 360.0),
          source.origin_deg.y - (tile.row + 1) * source.tile_deg.y};
}

bool in_latitudes(const MapSource& source, MapTile tile) {
  const double south = tile_corner(source, tile).y;
  return south + source.tile_deg.y > source.latitudes[0] && south < source.latitudes[1];
}

int tile_columns(const MapSource& source, int row) {
  const double south = tile_corner(source, {0, row}).y;
  const double north = south + source.tile_deg.y;
  // A tile across the equator touches it.
  const double nearest = south >= 0.0 ? south : north <= 0.0 ? -north : 0.0;
  int count = source.columns.front().count;
  for (const MapSource::Columns& step : source.columns)
    if (nearest >= step.from_latitude - 1e-9) count = step.count;
  return count;
}

namespace {

// "N46", "W005"; of fractional degrees the whole part, as in the names of services.
std::string degrees_name(double degrees, const char* letters, int digits) {
  const int whole = static_cast<int>(std::lround(std::floor(degrees + 1e-9)));
  return fmt::format("{}{:0{}}", whole < 0 ? letters[1] : letters[0], std::abs(whole), digits);
}

}  // namespace

std::string tile_name(const MapSource& source, MapTile tile) {
  const glm::dvec2 corner = tile_corner(source, tile);
  return degrees_name(corner.y, "NS", 2) + degrees_name(corner.x, "EW", 3);
}

std::string tile_address(const MapSource& source, MapTile tile, const std::string& mirror) {
  const glm::dvec2 corner = tile_corner(source, tile);
  const int around = static_cast<int>(std::lround(360.0 / source.tile_deg.x));
  const auto value_of = [&](const Field& field) {
    if (field.name == "lat") return degrees_name(corner.y, "NS", field.digits.value_or(2));
    if (field.name == "lon") return degrees_name(corner.x, "EW", field.digits.value_or(3));
    const int number = field.name == "row" ? tile.row : ((tile.column % around) + around) % around;
    return fmt::format("{:0{}}", number, field.digits.value_or(1));
  };
  std::string address;
  std::size_t done = 0;
  for (std::optional<Field> field = next_field(source.url, 0); field;
       field = next_field(source.url, done)) {
    address += source.url.substr(done, field->begin - done) + value_of(*field);
    done = field->end;
  }
  address += source.url.substr(done);
  if (mirror.empty()) return address;
  const std::size_t path = address.find('/', address.find("//") + 2);
  return mirror.substr(0, mirror.find_last_not_of('/') + 1) +
         (path == std::string::npos ? "" : address.substr(path));
}

}  // namespace belvedere
