#pragma once

#include <string>

#include "terrain/io/raster_source.h"

namespace belvedere {

// A note on a file whose centre lies far outside the area of use of its coordinate system
// (doubt_of_place), as happens if its own system is unknown and a wrong one is given for it. Empty
// if the position is plausible. Throws Error(input) as read_raster_info.
std::string doubt_of_source(const RasterSource& source);

}  // namespace belvedere
