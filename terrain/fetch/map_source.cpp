#include "terrain/fetch/map_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>

#include "base/config.h"
#include "base/error.h"
#include "base/text/embedded.h"
#include "terrain/io/crs.h"
#include "terrain/io/http_access.h"

namespace belvedere {
namespace {

// Reads the keys of one table and reports what is wrong with them.
class Keys {
 public:
  Keys(const ConfigTable& table, const std::string& name, std::string prefix)
      : table_(table), name_(name), prefix_(std::move(prefix)) {}

  [[noreturn]] void refuse(const ConfigValue& value, const std::string& found,
                           const std::string& allowed) const {
    throw Error(ErrorKind::usage, config_where(name_, value.position), found, allowed);
  }
  const ConfigValue* maybe(const char* key) const { return find(table_, key); }
  const ConfigValue& required(const char* key, const char* allowed) const {
    const ConfigValue* value = maybe(key);
    if (value == nullptr)
      throw Error(ErrorKind::usage, name_, fmt::format("missing key {}{}", prefix_, key), allowed);
    return *value;
  }
  std::string text(const char* key, const char* meaning) const {
    const ConfigValue& value = required(key, meaning);
    std::string text = as_string(value, name_);
    if (text.empty()) refuse(value, fmt::format("{}{} is empty", prefix_, key), meaning);
    return text;
  }
  std::string text_or(const char* key, const std::string& otherwise) const {
    const ConfigValue* value = maybe(key);
    return value == nullptr ? otherwise : as_string(*value, name_);
  }
  // The index of a word in a list.
  int choice(const char* key, const std::vector<std::string>& words) const {
    const std::string allowed = fmt::format("\"{}\"", fmt::join(words, "\", \""));
    const ConfigValue& value = required(key, allowed.c_str());
    const auto found = std::find(words.begin(), words.end(), as_string(value, name_));
    if (found == words.end())
      refuse(value, fmt::format("{}{} is {}", prefix_, key, describe(value)), allowed);
    return static_cast<int>(found - words.begin());
  }
  double number(const ConfigValue& value, const char* key, double min, double max) const {
    const double number = as_number(value, name_);
    if (!(number >= min && number <= max))
      refuse(value, fmt::format("{}{} is {}", prefix_, key, number),
             fmt::format("{} … {}", min, max));
    return number;
  }
  std::array<double, 2> pair(const char* key, double min, double max) const {
    const ConfigValue& value = required(key, "two numbers");
    const ConfigArray& both = as_array(value, name_);
    if (both.size() != 2)
      refuse(value, fmt::format("{}{} has {} numbers", prefix_, key, both.size()), "two numbers");
    return {number(both[0], key, min, max), number(both[1], key, min, max)};
  }
  const std::string& name() const { return name_; }

 private:
  const ConfigTable& table_;
  const std::string& name_;
  std::string prefix_;
};

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

void check_url(const Keys& keys, const ConfigValue& value, const std::string& url) {
  const char* const allowed =
      "https://SERVER/…{lat}…{lon}….tif, or with {row} and {column}; {lat:3} for three digits";
  if (!is_address(url)) keys.refuse(value, "url is not a valid URL", allowed);
  std::vector<std::string> names;
  for (std::optional<Field> field = next_field(url, 0); field;
       field = next_field(url, field->end)) {
    const std::vector<std::string> known = {"lat", "lon", "row", "column"};
    if (std::find(known.begin(), known.end(), field->name) == known.end())
      keys.refuse(value,
                  fmt::format("url contains the unknown field {}",
                              url.substr(field->begin, field->end - field->begin)),
                  allowed);
    names.push_back(field->name);
  }
  const auto has = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (!(has("lat") && has("lon")) && !(has("row") && has("column")))
    keys.refuse(value, "url is the same for all tiles", allowed);
  const std::size_t server = url.find("//") + 2;
  if (url.find('{') < url.find('/', server))
    keys.refuse(value, "url has a field in the host name", allowed);
  check_address(url);
}

void read_grid(MapSource& source, const ConfigValue& value, const std::string& name) {
  const ConfigTable& table = as_table(value, name);
  allow_only(table, {"crs", "tile_deg", "origin_deg", "latitudes", "rows", "columns", "cells"},
             name);
  const Keys keys(table, name, "grid.");
  source.crs = keys.text("crs", "a geographic coordinate system such as \"EPSG:4326\"");
  try {
    if (!crs_traits(source.crs).geographic)
      keys.refuse(*keys.maybe("crs"), "grid.crs is not in degrees",
                  "a geographic coordinate system such as \"EPSG:4326\"");
  } catch (const Error& error) {
    keys.refuse(*keys.maybe("crs"), "grid.crs: " + error.found(), error.allowed());
  }
  const std::array<double, 2> tile = keys.pair("tile_deg", 0.001, 180.0);
  source.tile_deg = {tile[0], tile[1]};
  if (!divides(tile[0], 360.0) || !divides(tile[1], 180.0))
    keys.refuse(*keys.maybe("tile_deg"), fmt::format("tiles of {}° × {}°", tile[0], tile[1]),
                "widths that divide 360°, heights that divide 180°");
  if (keys.maybe("origin_deg") != nullptr) {
    const std::array<double, 2> origin = keys.pair("origin_deg", -180.0, 180.0);
    source.origin_deg = {origin[0], origin[1]};
    if (origin[1] > 90.0 || !divides(tile[1], 90.0 - origin[1]))
      keys.refuse(*keys.maybe("origin_deg"), fmt::format("a first row from {}° N", origin[1]),
                  "90, or a whole number of tiles south of it");
  }
  if (keys.maybe("latitudes") != nullptr) source.latitudes = keys.pair("latitudes", -90.0, 90.0);
  if (!(source.latitudes[0] < source.latitudes[1]))
    keys.refuse(*keys.maybe("latitudes"), "the first latitude is not south of the second",
                "the southernmost, then the northernmost");
  constexpr double max_cells = 100000.0;
  const ConfigValue& rows =
      keys.required("rows", "the number of cells of a tile from north to south");
  source.rows = static_cast<int>(as_integer(rows, name));
  keys.number(rows, "rows", 1.0, max_cells);
  const ConfigValue& columns = keys.required(
      "columns",
      "[latitude, number of cells from west to east] rows, such as [[0, 3600], [50, 2400]]");
  for (const ConfigValue& step : as_array(columns, name)) {
    const ConfigArray& both = as_array(step, name);
    if (both.size() != 2)
      keys.refuse(step, fmt::format("grid.columns has a row of {} numbers", both.size()),
                  "[latitude, cells]");
    const double from = keys.number(both[0], "columns", 0.0, 90.0);
    keys.number(both[1], "columns", 1.0, max_cells);
    if (source.columns.empty() ? from != 0.0 : from <= source.columns.back().from_latitude)
      keys.refuse(both[0], fmt::format("grid.columns has the latitude {}°", from),
                  "latitudes in ascending order from 0");
    source.columns.push_back({from, static_cast<int>(as_integer(both[1], name))});
  }
  if (source.columns.empty()) keys.refuse(columns, "grid.columns is empty", "[[0, 3600]]");
  source.on_lines = keys.choice("cells", {"on the lines", "between the lines"}) == 0;
}

MapSource source_of(const ConfigValue& root, const std::string& name) {
  const ConfigTable& table = as_table(root, name);
  allow_only(table,
             {"name", "kind", "url", "date", "legend", "cell_m", "missing", "sea_value", "get_from",
              "credit", "licence", "grid"},
             name);
  const Keys keys(table, name, "");
  MapSource source;
  source.id = std::filesystem::path(name).stem().string();
  source.name = keys.text("name", "the name of the source");
  source.kind = keys.choice("kind", {"elevation", "land_cover"}) == 0 ? MapSourceKind::elevation
                                                                      : MapSourceKind::land_cover;
  source.url = keys.text("url", "https://SERVER/…{lat}…{lon}….tif");
  check_url(keys, *keys.maybe("url"), source.url);
  source.date = keys.text_or("date", "");
  source.cell_m = keys.number(keys.required("cell_m", "metres"), "cell_m", 0.1, 10000.0);
  source.missing = static_cast<MissingTile>(keys.choice("missing", {"sea", "nothing", "error"}));
  const bool cover = source.kind == MapSourceKind::land_cover;
  if (source.missing == MissingTile::sea) {
    const ConfigValue& value = keys.required("sea_value", cover ? "the code of water" : "0");
    source.sea_value = cover ? keys.number(value, "sea_value", 0.0, 65535.0)
                             : keys.number(value, "sea_value", -12000.0, 9000.0);
  } else if (const ConfigValue* stray = keys.maybe("sea_value")) {
    keys.refuse(*stray, "sea_value without missing = \"sea\"", "missing = \"sea\"");
  }
  if (cover)
    source.legend = keys.text("legend", "a built-in legend or a file, as for a scene's land cover");
  else if (const ConfigValue* stray = keys.maybe("legend"))
    keys.refuse(*stray, "legend for an elevation source", "kind = \"land_cover\"");
  source.get_from = keys.text_or("get_from", "");
  source.credit = keys.text("credit", "the attribution that pictures must show");
  source.licence = keys.text("licence", "the terms of use of the data");
  read_grid(source, keys.required("grid", "a table [grid] with the positions of tiles"), name);
  return source;
}

}  // namespace

MapSource parse_map_source(const std::string& text, const std::string& name) {
  return source_of(parse_config(text, name), name);
}

std::vector<std::string> built_in_map_sources() { return embedded_names("sources"); }

MapSource read_map_source(const std::string& name_or_path) {
  const std::string extension = std::filesystem::path(name_or_path).extension().string();
  if (extension == ".toml") return source_of(read_config(name_or_path), name_or_path);
  const std::vector<std::string> known = built_in_map_sources();
  if (std::find(known.begin(), known.end(), name_or_path) == known.end()) {
    const std::string near = nearest_word(name_or_path, known);
    throw Error(ErrorKind::usage, "source",
                fmt::format("unknown source \"{}\"{}", name_or_path,
                            near.empty() ? "" : "; did you mean \"" + near + "\"?"),
                fmt::format("{}, or a .toml file", fmt::join(known, ", ")));
  }
  const std::string name = "sources/" + name_or_path + ".toml";
  return parse_map_source(std::string(embedded_file(name)), name);
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
