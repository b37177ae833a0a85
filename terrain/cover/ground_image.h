#pragma once

#include <string>

#include "base/progress.h"
#include "terrain/cover/land_cover.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// A picture of the ground from above (red, green and blue, 8 bits, encoded sRGB) on the cells of a frame: means where it is finer, smooth
// where it is coarser, unknown where it has nothing. Error(input) where it has fewer than three bands or values beyond 255, and where
// it shows nothing of a frame that it must_overlap.
Raster<GroundColour> read_ground_image(const std::string& path, const RasterFrame& frame, bool must_overlap, Progress& progress);

}  // namespace belvedere
