#pragma once

#include <cstdint>
#include <string>

#include "base/grid.h"

namespace belvedere::image_io {

// The indices of a PNG with a palette.
Grid<std::uint16_t> read_palette_png(const std::string& path);

// A mask or label map as grey PNG of 8 bits, its numbers as they are; read_grey reads them back. Error(output).
void write_grey_png(const std::string& path, const Grid<std::uint8_t>& grey);

}  // namespace belvedere::image_io
