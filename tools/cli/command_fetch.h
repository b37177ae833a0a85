#pragma once

#include <string>
#include <vector>

#include "terrain/fetch/fetch_area.h"

namespace belvedere::tools {

class CommandOptions;

// Options shared by commands that fetch an area: position, size, sources, and server settings.
struct FetchOptions {
  std::string at;                    // "LON,LAT"; empty: not given
  std::string size = "60";           // km: "60", or "80x50" west to east and south to north
  std::vector<std::string> sources;  // each replaces the source of the same kind
  bool no_land_cover = false;
  double cell_m = 0.0;
  double cover_cell_m = 0.0;
  std::string mirror;
  bool refresh = false;
  bool replace = false;  // also files in the folder that others wrote
  HttpOptions http_options;
};

// --http-silence only if the command lacks it; otherwise the command fills http_options.silence_s.
void add_fetch_options(CommandOptions& command, FetchOptions& options);
// Adds all of these options except --at, --size and --no-land-cover.
void add_source_options(CommandOptions& command, FetchOptions& options);
// The head of the record of fetched data: tables that are ready for a scene beside it.
std::string sources_for_scenes(const FetchedArea& area);
// Error(usage) for text that cannot be parsed; fetch_area checks the range of positions and sizes.
FetchParameters fetch_parameters(const FetchOptions& options);

}  // namespace belvedere::tools
