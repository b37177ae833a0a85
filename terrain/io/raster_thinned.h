#pragma once

#include <optional>

#include "base/progress.h"
#include "terrain/io/raster.h"
#include "terrain/io/raster_source.h"

namespace belvedere {

// A preview of a file that is too large to read: at most `longest` of its cells per side, evenly
// spaced, unchanged from the file (or only from its overviews, if it has some). In the file's own
// CRS; metres, voids NaN. Nothing if its cells are rotated. Notes what was taken as void
// though no header says so. Throws as in raster_io.h.
std::optional<Raster<float>> read_thinned(const RasterSource& source, int longest,
                                          Progress& progress = silent_progress());

}  // namespace belvedere
