#pragma once

#include <optional>

#include "terrain/io/raster.h"
#include "terrain/io/raster_source.h"

namespace belvedere {

// A look at a file that is too large to be read: at most `longest` of its cells a side, evenly spaced, each as it stands in the file (or in
// its overviews, where it has some: then only those are read). In the file's own CRS; metres, voids NaN. Nothing where its cells lie
// askew. Throws as raster_io.h says.
std::optional<Raster<float>> read_thinned(const RasterSource& source, int longest);

}  // namespace belvedere
