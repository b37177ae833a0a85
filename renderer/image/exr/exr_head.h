#pragma once

#include <bit>
#include <string>
#include <vector>

#include "renderer/image/image_file.h"

namespace belvedere {

// Appends a number little-endian, as in files and in memory here.
static_assert(std::endian::native == std::endian::little);
template <class Number>
void put_number(std::string& out, Number number) {
  out.append(reinterpret_cast<const char*>(&number), sizeof number);
}

// The bytes of a tiled OpenEXR file before its tables of offsets: magic number, version, and a
// header for each part, made by the library. ZIP, primaries of sRGB; notes go to the first part,
// those of a PartSpec to theirs. Error(bug) for duplicate parts or channels, notes named like
// OpenEXR's own attributes, unknown types.
std::string exr_head(const std::string& path, int width, int height, int tile_px,
                     const std::vector<PartSpec>& parts, const FileNotes& notes);

}  // namespace belvedere
