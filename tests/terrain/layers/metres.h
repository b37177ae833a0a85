#pragma once

#include "terrain/io/raster.h"

namespace belvedere::test {

// Cells of 10 m.
inline const GeoTransform metres{600'000.0, 5'200'000.0, 10.0, 10.0};

}  // namespace belvedere::test
