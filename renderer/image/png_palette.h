#pragma once

#include <cstdint>
#include <string>

#include "base/grid.h"

namespace belvedere::image_io {

// The indices of a PNG with a palette.
Grid<std::uint16_t> read_palette_png(const std::string& path);

}  // namespace belvedere::image_io
