#include "tools/cli/new/new_options.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <string_view>

#include "base/error.h"
#include "base/text/parse_number.h"
#include "tools/options/options.h"

namespace belvedere::tools {

void add_new_options(CommandOptions& command, NewOptions& options) {
  command.add_option(
      "DEM", options.dems,
      "Elevation of the region: one file, or several that are joined; or use --at to fetch it");
  command.add_option("--out FILE", options.out, "The scene file to write")
      .required()
      .files(FileUse::writes);
  command.add_flag("--force", options.force, "Replaces an existing scene file");
  command
      .add_option(
          "--pictures DIR", options.pictures,
          "Renders small pictures of all proposals to this folder, with the sheet proposals.png")
      .files(FileUse::folder);
  command.add_option("--choose N", options.choose, "Number of the proposal to write")
      .show_default()
      .range(1, 12);
  command.add_option("--proposals N", options.max, "Maximum number of proposals")
      .show_default()
      .range(1, 12);
  command.add_option(
      "--towards DIRECTION", options.towards,
      "Direction of view: N, NE, southwest … or an azimuth in degrees; ±15° are allowed");
  command.add_option("--from LON,LAT", options.from,
                     "Position of the viewer: longitude and latitude");
  command
      .add_option("--include [NAME|]LON,LAT", options.include,
                  "A place that must be in the picture: \"Innsbruck|11.39,47.27\" or 11.39,47.27; "
                  "may be repeated")
      .repeated();
  command
      .add_option("--format FORMAT", options.format,
                  "Shape of the sheet: 2:1, 3:1 …; A2, \"A2 upright\"; 2400x1200 pixels; cylinder, "
                  "\"cylinder 8:1\" for a full circle")
      .show_default();
  command.add_flag("--plain", options.plain,
                   "Does not widen valleys or raise summits for a better picture; the land is only "
                   "raised and bent as a whole");
  command.add_option("--title TEXT", options.title, "Title of the scene. Default: the file's name");
  command.add_option(
      "--style STYLE", options.style,
      "The look of a painting: segantini, gogh, monet, turner, rubens, bruegel, or a "
      "file of belvedere style fit");
  command.add_option(
      "--crs CRS", options.crs,
      "Coordinate system of files that do not state it: EPSG:32632, or its definition");
  add_elevation_options(command, options.elevation);
  command.add_option("--lowest M", options.lowest_m,
                     "Altitudes below this are errors of the data, in metres");
  const Option cover =
      command.add_option("--land-cover FILE", options.cover.file,
                         "A raster of land cover. Default: classified by climate and terrain");
  command.add_option("--legend NAME", options.cover.legend,
                     "Meaning of its codes: nlcd, corine, esa_worldcover, fbfm40, or a file");
  command
      .add_option("--land-cover-band N", options.cover.band,
                  "Band of that file that holds the codes, if not the first")
      .range(1, 65535)
      .needs(cover);
  command
      .add_option("--land-cover-variable NAME", options.cover.variable,
                  "Name of the raster of codes in a file that contains several")
      .needs(cover);
  command
      .add_option("--land-cover-crs CRS", options.cover.crs,
                  "Its coordinate system, if the file does not state it and it differs from --crs: "
                  "EPSG:26911, or its definition")
      .needs(cover);
  command
      .add_option("--land-cover-unknown CLASS", options.cover.unknown,
                  "The class of codes that the legend lacks, such as shrub")
      .needs(cover);
  add_file_options(command, options.common);
  add_fetch_options(command, options.fetch);
  command.add_option("--fetched DIR", options.fetched,
                     "Folder for what --at fetches. Default: beside the scene, SCENE_data");
  add_run_options(command, options.common);
  command.footer(
      "Analyses the elevation alone and proposes different views: position, direction, bend and "
      "exaggeration of the ground.\n"
      "Sky, foreground and horizon are laid out by rule; mountains, canyons, lakes, open valleys "
      "and ranges decide which view\n"
      "is best. The scene states the reason of each value; change what you like, and belvedere "
      "check evaluates it by the\n"
      "same measures.\n"
      "\n"
      "  belvedere new my_dem.tif --out scene.toml\n"
      "  belvedere new my_dem.tif --out scene.toml --pictures proposals\n"
      "  belvedere new my_dem.tif --out scene.toml --choose 2 --force\n"
      "  belvedere new --at 11.4,47.35 --size 60 --out karwendel.toml\n"
      "  belvedere new my_dem.tif --out scene.toml --towards south --format 3:1 --include "
      "\"Innsbruck|11.39,47.27\"");
}

namespace {

std::string small_letters(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

std::optional<double> number(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const std::optional<double> value = parse_number<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

// Two numbers with one sign between them.
std::optional<glm::dvec2> pair_of(std::string_view text, char sign) {
  const std::size_t at = text.find(sign);
  if (at == std::string_view::npos) return std::nullopt;
  const std::optional<double> a = number(text.substr(0, at));
  const std::optional<double> b = number(text.substr(at + 1));
  if (!a || !b) return std::nullopt;
  return glm::dvec2(*a, *b);
}

struct Direction {
  std::string_view letters, name;
};
constexpr std::array<Direction, 16> directions = {{{"n", "north"},
                                                   {"nne", "north-northeast"},
                                                   {"ne", "northeast"},
                                                   {"ene", "east-northeast"},
                                                   {"e", "east"},
                                                   {"ese", "east-southeast"},
                                                   {"se", "southeast"},
                                                   {"sse", "south-southeast"},
                                                   {"s", "south"},
                                                   {"ssw", "south-southwest"},
                                                   {"sw", "southwest"},
                                                   {"wsw", "west-southwest"},
                                                   {"w", "west"},
                                                   {"wnw", "west-northwest"},
                                                   {"nw", "northwest"},
                                                   {"nnw", "north-northwest"}}};

// Long side of A0, mm; each further one is shorter by the root of two, rounded down as in ISO 216.
constexpr std::array<int, 8> paper_long_mm = {1189, 841, 594, 420, 297, 210, 148, 105};

void check_aspect(const std::string& text, double aspect) {
  constexpr double min = 0.5, max = 12.0;
  if (!(aspect >= min && aspect <= max))
    throw Error(ErrorKind::usage, "--format",
                fmt::format("\"{}\" is {:.2f} times as wide as it is high", text, aspect),
                "from 1:2 to 12:1, such as 1:1, 2:1, 5:1");
}

}  // namespace

double read_direction(const std::string& text) {
  const std::string word = small_letters(text);
  for (std::size_t i = 0; i < directions.size(); ++i)
    if (word == directions[i].letters || word == directions[i].name)
      return 22.5 * static_cast<double>(i);
  const std::optional<double> degrees = number(word);
  if (!degrees || *degrees < -360.0 || *degrees > 360.0)
    throw Error(ErrorKind::usage, "--towards", fmt::format("\"{}\" is not a direction", text),
                "N, NE, southwest … or an azimuth in degrees, clockwise from north: 225");
  return *degrees < 0.0 ? *degrees + 360.0 : *degrees;
}

glm::dvec2 read_lonlat(const std::string& option, const std::string& text) {
  const std::optional<glm::dvec2> position = pair_of(text, ',');
  if (!position || std::abs(position->x) > 180.0 || std::abs(position->y) > 90.0)
    throw Error(ErrorKind::usage, option, fmt::format("\"{}\" is not a position", text),
                "longitude and latitude in degrees: 11.4,47.27");
  return *position;
}

NamedPlace read_named_place(const std::string& text) {
  const std::size_t bar = text.rfind('|');
  if (bar != std::string::npos)
    return {text.substr(0, bar), read_lonlat("--include", text.substr(bar + 1))};
  if (!pair_of(text, ','))
    throw Error(ErrorKind::usage, "--include",
                fmt::format("\"{}\" is a name, and the program has no gazetteer", text),
                fmt::format("the name with its longitude and latitude: \"{}|11.4,47.27\"", text));
  return {"", read_lonlat("--include", text)};
}

SheetFormat read_format(const std::string& text) {
  SheetFormat out;
  const std::string word = small_letters(text);
  if (word == "cylinder" || word == "360") {
    constexpr double usual = 10.0;
    out.picture = {.aspect = usual, .full_turn = true};
    out.width_px = 6000;
    out.sheet_width_mm = 3000.0;
    return out;
  }
  if (word.starts_with("cylinder ")) {
    const SheetFormat shape = read_format(word.substr(9));
    constexpr double min = 5.0;
    if (shape.picture.aspect < min)
      throw Error(ErrorKind::usage, "--format",
                  fmt::format("\"{}\" is too high for a full circle", text), "5:1 … 12:1");
    out = shape;
    out.picture.full_turn = true;
    return out;
  }
  if (const std::optional<glm::dvec2> sides = pair_of(word, ':');
      sides && sides->x > 0.0 && sides->y > 0.0) {
    out.picture.aspect = sides->x / sides->y;
    check_aspect(text, out.picture.aspect);
    return out;
  }
  if (const std::optional<glm::dvec2> pixels = pair_of(word, 'x');
      pixels && pixels->x >= 64.0 && pixels->y >= 64.0 && pixels->x <= 65535.0) {
    out.picture.aspect = pixels->x / pixels->y;
    check_aspect(text, out.picture.aspect);
    out.width_px = static_cast<int>(pixels->x);
    return out;
  }
  if (word.size() >= 2 && word[0] == 'a' && word[1] >= '0' &&
      word[1] < '0' + static_cast<int>(paper_long_mm.size()) - 1) {
    const auto size = static_cast<std::size_t>(word[1] - '0');
    const double longer = paper_long_mm[size];
    const double shorter = paper_long_mm[size + 1];
    const std::string rest = word.substr(2);
    const bool upright = rest == " upright" || rest == "-upright";
    if (rest.empty() || upright) {
      out.picture.aspect = upright ? shorter / longer : longer / shorter;
      out.sheet_width_mm = upright ? shorter : longer;
      return out;
    }
  }
  throw Error(
      ErrorKind::usage, "--format", fmt::format("\"{}\" is not a format", text),
      "2:1, 3:1 …; A2, \"A2 upright\"; 2400x1200; cylinder, \"cylinder 8:1\" for a full circle");
}

}  // namespace belvedere::tools
