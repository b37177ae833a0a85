#pragma once

#include <string>

#include "terrain/io/raster_source.h"

namespace belvedere {

// A note on a file whose middle lies far from where the coordinate system is used that it is said to be in (doubt_of_place), as happens
// where a file's own system is not known and another is given for it. Empty where nothing is to be said. Throws Error(input) as
// read_raster_info.
std::string doubt_of_source(const RasterSource& source);

}  // namespace belvedere
