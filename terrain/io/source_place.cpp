#include "terrain/io/source_place.h"

#include <fmt/core.h>

#include "terrain/io/crs.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

std::string doubt_of_source(const RasterSource& source) {
  const RasterInfo info = read_raster_info(source);
  const std::string& crs = source.crs.empty() ? info.crs : source.crs;
  if (crs.empty()) return {};
  const std::string doubt =
      doubt_of_place(crs, info.transform.to_crs(.5 * (info.width - 1), .5 * (info.height - 1)));
  return doubt.empty() ? doubt
                       : fmt::format("{}: lies at {}; check its coordinate system (`crs`)",
                                     source.path, doubt);
}

}  // namespace belvedere
