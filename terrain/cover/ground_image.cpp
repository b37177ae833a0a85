#include "terrain/cover/ground_image.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"

namespace belvedere {

Raster<GroundColour> read_ground_image(const std::string& path, const RasterFrame& frame,
                                       bool must_overlap, Progress& progress) {
  RasterSource source;
  source.path = path;
  source.unit_to_m = 1.0;  // colours: no conversion
  const RasterInfo info = read_raster_info(source);
  if (info.bands < 3)
    throw Error(ErrorKind::input, path,
                fmt::format("has {} band{}", info.bands, info.bands == 1 ? "" : "s"),
                "3 bands: red, green and blue");
  Raster<GroundColour> colours{
      Grid<GroundColour>(frame.width, frame.height, GroundColour(0, 0, 0, 255)), frame.transform,
      frame.crs};
  for (int band = 0; band < 3; ++band) {
    source.band = band + 1;
    const Grid<float> values = warp_rasters({source}, frame, progress).cells;
    for (std::size_t i = 0; i < values.size(); ++i) {
      GroundColour& colour = colours.cells[i];
      if (!std::isfinite(values[i])) {
        colour = GroundColour(0);
        continue;
      }
      if (values[i] < 0.F || values[i] > 255.F)
        throw Error(ErrorKind::input, path, fmt::format("contains the value {}", values[i]),
                    "8-bit values, 0…255");
      if (colour.a != 0) colour[band] = static_cast<std::uint8_t>(values[i] + 0.5F);
    }
  }
  const bool any = std::any_of(colours.cells.begin(), colours.cells.end(),
                               [](const GroundColour& colour) { return colour.a != 0; });
  if (must_overlap && !any)
    throw Error(ErrorKind::input, path, "does not cover the terrain",
                "an orthophoto of the terrain");
  return colours;
}

}  // namespace belvedere
