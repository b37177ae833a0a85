#pragma once

#include <string>
#include <vector>

#include "terrain/fetch/fetch_area.h"

namespace belvedere::tools {

class CommandOptions;

// What commands that fetch an area have in common: place, size, sources, and how servers are asked.
struct FetchOptions {
  std::string at;                    // "LON,LAT"; empty: not given
  std::string size = "60";           // km: "60", or "80x50" west to east and south to north
  std::vector<std::string> sources;  // each takes the place of the one of its kind
  bool no_land_cover = false;
  double cell_m = 0.0;
  double cover_cell_m = 0.0;
  std::string mirror;
  bool refresh = false;
  HttpManners manners;
};

// --http-silence only where the command has none yet: then manners.silence_s is the command's to fill.
void add_fetch_options(CommandOptions& command, FetchOptions& options);
// What stands first in the record of fetched data: tables that are ready for a scene beside it.
std::string sources_for_scenes(const FetchedArea& area);
// Error(usage) for what cannot be understood; places and sizes out of range are told by fetch_area.
FetchParameters fetch_parameters(const FetchOptions& options);

}  // namespace belvedere::tools
