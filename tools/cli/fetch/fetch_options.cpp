#include "tools/cli/fetch/fetch_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/error.h"
#include "renderer/image/provenance.h"
#include "renderer/scene/fetched_sources.h"
#include "tools/cli/deform_options.h"
#include "tools/options/options.h"

namespace belvedere::tools {
namespace {

// "60" or "80x50", km.
glm::dvec2 parse_size(const std::string& text) {
  const std::size_t cross = text.find('x');
  const auto number = [&](const std::string& part) {
    std::size_t end = 0;
    double value = 0.0;
    try {
      value = std::stod(part, &end);
    } catch (const std::exception&) {
      end = std::string::npos;
    }
    if (end != part.size())
      throw Error(ErrorKind::usage, "--size", fmt::format("\"{}\"", text),
                  "kilometres: 60, or 80x50");
    return value;
  };
  if (cross == std::string::npos) return glm::dvec2(number(text));
  return {number(text.substr(0, cross)), number(text.substr(cross + 1))};
}

}  // namespace

void add_fetch_options(CommandOptions& command, FetchOptions& options) {
  command
      .add_option(
          "--at", options.at,
          "The centre of the area: longitude and latitude in degrees, west and south negative")
      .type_name("LON,LAT");
  command
      .add_option("--size", options.size,
                  "Size of the area in km: a side of the square, or west to east x south to north. "
                  "Default: 60")
      .type_name("KM");
  command.add_flag("--no-land-cover", options.no_land_cover, "Only the elevation");
  add_source_options(command, options);
}

void add_source_options(CommandOptions& command, FetchOptions& options) {
  command
      .add_option("--source", options.sources,
                  fmt::format("A source instead of copernicus_glo30 or esa_worldcover: {}, or a "
                              ".toml file (docs/fetch.md); may be repeated",
                              fmt::join(built_in_map_sources(), ", ")))
      .type_name("NAME")
      .repeated();
  command
      .add_option("--cell", options.cell_m,
                  "Cell size of the elevation in m. Default: the source's, 30")
      .type_name("M");
  command
      .add_option("--cover-cell", options.cover_cell_m,
                  "Cell size of the land cover in m. Default: the source's, 10, up to 80 × 80 km")
      .type_name("M");
  command
      .add_option(
          "--mirror", options.mirror,
          "A mirror that serves the sources' files under the same paths; also $BELVEDERE_MIRROR")
      .type_name("URL")
      .environment("BELVEDERE_MIRROR");
  command.add_flag(
      "--refresh", options.refresh,
      "Asks the server whether cached files have changed; otherwise they are used for 30 days");
  // A command whose scene may have files on servers already has this option.
  if (!command.has_option("--http-silence"))
    command
        .add_option("--http-silence", options.http_options.silence_s,
                    "Timeout in seconds: how long a server may send nothing before the connection "
                    "counts as lost")
        .type_name("S")
        .show_default();
  command
      .add_option("--http-time", options.http_options.answer_s,
                  "Maximum duration of one response of a server, in seconds")
      .type_name("S")
      .show_default();
  command
      .add_option("--http-retries", options.http_options.retries,
                  "Number of retries of a failed request, with increasing delay")
      .type_name("N")
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

}  // namespace belvedere::tools
