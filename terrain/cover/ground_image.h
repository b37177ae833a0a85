#pragma once

#include <string>

#include "base/progress.h"
#include "terrain/cover/land_cover.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// An orthophoto (red, green and blue, 8 bits, encoded sRGB) on the cells of a frame: averaged where
// it is finer, smoothly interpolated where it is coarser, unknown where it has no data.
// Error(input) if it has fewer than three bands or values beyond 255, and if it does not cover any
// of a frame that it must_overlap.
Raster<GroundColour> read_ground_image(const std::string& path, const RasterFrame& frame,
                                       bool must_overlap, Progress& progress);

}  // namespace belvedere
