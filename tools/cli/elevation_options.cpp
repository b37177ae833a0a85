#include "tools/cli/elevation_options.h"

namespace belvedere::tools {

void add_elevation_options(CommandOptions& command, ElevationOptions& options) {
  command
      .add_option("--encoding", options.encoding,
                  "How the colours of map tiles encode heights: terrarium or mapbox (Terrain-RGB). "
                  "Default: the values are heights")
      .type_name("NAME")
      .one_of({"terrarium", "mapbox"});
  command
      .add_option("--variable", options.variable,
                  "Name of the raster with heights in a file that contains several (netCDF, "
                  "GeoPackage)")
      .type_name("NAME");
}

RasterSource elevation_source(const std::string& path, const ElevationOptions& options) {
  RasterSource source;
  source.path = path;
  source.encoding = options.encoding;
  source.variable = options.variable;
  return source;
}

}  // namespace belvedere::tools
