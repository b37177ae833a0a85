#include "tools/cli/command_fetch.h"

#include <fmt/core.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "base/cache/cache.h"
#include "base/error.h"
#include "base/text/json.h"
#include "base/text/parse_number.h"
#include "renderer/image/provenance.h"
#include "renderer/scene/fetched_sources.h"
#include "terrain/io/crs.h"
#include "tools/cli/commands.h"
#include "tools/cli/deform_options.h"
#include "tools/cli/scene_options.h"
#include "tools/cli/terminal.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

// "60" or "80x50", km.
glm::dvec2 parse_size(const std::string& text) {
  const std::size_t cross = text.find('x');
  const auto number = [&](const std::string& part) {
    if (const std::optional<double> value = parse_number<double>(part)) return *value;
    throw Error(ErrorKind::usage, "--size", fmt::format("\"{}\"", text),
                "kilometres: 60, or 80x50");
  };
  if (cross == std::string::npos) return glm::dvec2(number(text));
  return {number(text.substr(0, cross)), number(text.substr(cross + 1))};
}

}  // namespace

void add_fetch_options(CommandOptions& command, FetchOptions& options) {
  command.add_option(
      "--at LON,LAT", options.at,
      "The centre of the area: longitude and latitude in degrees, west and south negative");
  command.add_option(
      "--size KM", options.size,
      "Size of the area in km: a side of the square, or west to east x south to north. "
      "Default: 60");
  command.add_flag("--no-land-cover", options.no_land_cover, "Only the elevation");
  add_source_options(command, options);
}

void add_source_options(CommandOptions& command, FetchOptions& options) {
  command
      .add_option("--source NAME", options.sources,
                  fmt::format("A source instead of copernicus_glo30 or esa_worldcover: {}, or a "
                              ".toml file (docs/fetch.md); may be repeated",
                              fmt::join(built_in_map_sources(), ", ")))
      .repeated();
  command.add_option("--cell M", options.cell_m,
                     "Cell size of the elevation in m. Default: the source's, 30");
  command.add_option(
      "--cover-cell M", options.cover_cell_m,
      "Cell size of the land cover in m. Default: the source's, 10, up to 80 × 80 km");
  command
      .add_option(
          "--mirror URL", options.mirror,
          "A mirror that serves the sources' files under the same paths; also $BELVEDERE_MIRROR")
      .environment("BELVEDERE_MIRROR");
  command.add_flag(
      "--refresh", options.refresh,
      "Asks the server whether cached files have changed; otherwise they are used for 30 days");
  // A command whose scene may have files on servers already has this option.
  if (!command.has_option("--http-silence"))
    command
        .add_option("--http-silence S", options.http_options.silence_s,
                    "Timeout in seconds: how long a server may send nothing before the connection "
                    "counts as lost")
        .show_default();
  command
      .add_option("--http-time S", options.http_options.answer_s,
                  "Maximum duration of one response of a server, in seconds")
      .show_default();
  command
      .add_option("--http-retries N", options.http_options.retries,
                  "Number of retries of a failed request, with increasing delay")
      .show_default();
}

std::string sources_for_scenes(const FetchedArea& area) { return fetched_sources(area, ""); }

FetchParameters fetch_parameters(const FetchOptions& options) {
  if (options.at.empty())
    throw Error(ErrorKind::usage, "--at", "no position is given", "--at LON,LAT");
  FetchParameters parameters;
  parameters.at_lonlat = parse_pair(options.at, "--at");
  parameters.size_km = parse_size(options.size);
  for (const std::string& name : options.sources)
    (read_map_source(name).kind == MapSourceKind::elevation ? parameters.elevation
                                                            : parameters.land_cover) = name;
  if (options.no_land_cover) parameters.land_cover.clear();
  parameters.replace = options.replace;
  parameters.cell_m = options.cell_m;
  parameters.cover_cell_m = options.cover_cell_m;
  parameters.mirror = options.mirror;
  parameters.refresh = options.refresh;
  parameters.http_options = options.http_options;
  parameters.http_options.agent = fmt::format("Belvedere/{} (panorama maps)", program_version());
  return parameters;
}

namespace {

struct FetchCommandOptions {
  FetchOptions fetch;
  SceneOptions run;  // threads, memory, cache, quiet, json
  std::string out;
};

double mib(std::uint64_t bytes) {
  constexpr double one = 1024.0 * 1024.0;
  return static_cast<double>(bytes) / one;
}

std::size_t missing_tiles(const FetchedMap& map) {
  return static_cast<std::size_t>(
      std::count_if(map.tiles.begin(), map.tiles.end(),
                    [](const FetchedTile& tile) { return tile.about.missing; }));
}

std::string as_text(const FetchCommandOptions& options, const FetchedArea& area) {
  std::string out;
  for (const FetchedMap* map : {&area.elevation, area.land_cover ? &*area.land_cover : nullptr}) {
    if (map == nullptr) continue;
    out += fmt::format(
        "{}/{}: {} × {} cells of {} m, {}; {}, {} tiles{}\n", options.out, map->file,
        map->frame.width, map->frame.height, map->frame.transform.cell_x,
        describe_crs(map->frame.crs), map->source.name, map->tiles.size(),
        missing_tiles(*map) > 0 ? fmt::format(", {} of them sea", missing_tiles(*map)) : "");
    out += fmt::format("  {}\n", map->source.credit);
  }
  out += fmt::format(
      "{}: origin of the data, and the tables for a scene\n"
      "{} requests, {:.1f} MiB\n",
      area.record, area.questions, mib(area.bytes));
  return out;
}

Json map_json(const FetchCommandOptions& options, const FetchedMap& map) {
  Json tiles = Json::array();
  for (const FetchedTile& tile : map.tiles)
    tiles.add(Json::object()
                  .add("name", Json::text(tile.name))
                  .add("missing", Json::boolean(tile.about.missing)));
  Json out = Json::object()
                 .add("file", Json::text(options.out + "/" + map.file))
                 .add("hash", Json::text(map.hash))
                 .add("source", Json::text(map.source.id))
                 .add("origin", Json::text(map.origin))
                 .add("licence", Json::text(map.licence))
                 .add("crs", Json::text(describe_crs(map.frame.crs)))
                 .add("width", Json::number(map.frame.width))
                 .add("height", Json::number(map.frame.height))
                 .add("cell_m", Json::number(map.frame.transform.cell_x));
  if (!map.source.legend.empty()) out.add("legend", Json::text(map.source.legend));
  return out.add("tiles", std::move(tiles));
}

Json as_json(const FetchCommandOptions& options, const FetchedArea& area) {
  Json out = Json::object().add("elevation", map_json(options, area.elevation));
  if (area.land_cover) out.add("land_cover", map_json(options, *area.land_cover));
  return out.add("record", Json::text(area.record))
      .add("questions", Json::number(static_cast<double>(area.questions)))
      .add("bytes", Json::number(static_cast<double>(area.bytes)));
}

int run(const FetchCommandOptions& options) {
  TerminalProgress progress(options.run.quiet);
  const Cache cache = make_cache(options.run);
  const RunLimits limits(make_run(options.run, Run{}.tile_px, progress, cache));
  const FetchedArea area =
      fetch_area(fetch_parameters(options.fetch), options.out, cache, progress, sources_for_scenes);
  progress.end();
  print_result(options.run, as_json(options, area), as_text(options, area));
  return 0;
}

}  // namespace

Action add_fetch(CommandOptions& command) {
  const auto options = std::make_shared<FetchCommandOptions>();
  add_fetch_options(command, options->fetch);
  command.option("--at").required();
  command
      .add_option(
          "--out DIR", options->out,
          "The folder for elevation.tif, land_cover.tif and fetched.toml; created if missing")
      .required()
      .files(FileUse::later);
  command.add_force(options->fetch.replace);
  add_run_options(command, options->run);
  command.footer(
      "Requests the parts of tiles that lie in the area from the servers of Copernicus DEM GLO-30 "
      "and ESA WorldCover, or of other sources.\n"
      "Downloads are cached: after a failure the same command continues where it stopped, and a "
      "second run requests nothing.\n"
      "Pictures of such data must name the sources: fetched.toml has the attributions, and scenes "
      "take them over.\n"
      "\n"
      "  belvedere fetch --at 11.4,47.35 --size 60 --out karwendel_data\n"
      "  belvedere fetch --at -121.76,46.85 --size 80x60 --source copernicus_glo90 --no-land-cover "
      "--out rainier_data");
  return [options] { return run(*options); };
}

}  // namespace belvedere::tools
