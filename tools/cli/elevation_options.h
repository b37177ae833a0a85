#pragma once

#include <string>

#include "terrain/io/raster_source.h"
#include "tools/options/options.h"

namespace belvedere::tools {

// Options of every command that reads elevation without a scene: what a scene says in the keys of
// terrain.sources.
struct ElevationOptions {
  std::string encoding, variable;
};
void add_elevation_options(CommandOptions& command, ElevationOptions& options);

RasterSource elevation_source(const std::string& path, const ElevationOptions& options);

}  // namespace belvedere::tools
