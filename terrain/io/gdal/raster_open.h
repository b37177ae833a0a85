#pragma once

#include "terrain/io/gdal/gdal_files.h"
#include "terrain/io/raster_io.h"

namespace belvedere {

// Settings of this thread that make reads strict: damaged blocks and short raw files are errors; no
// threads of its own.
void make_strict();

// Opens a raster of an allowed format; of a file of several, the one that `variable` names. Throws
// Error(input) as in raster_io.h, with the names of the rasters if the file has several.
Dataset open_raster(const RasterSource& source);

}  // namespace belvedere
