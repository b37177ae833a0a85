#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/grid.h"

namespace belvedere::image_io {

// The indices of a PNG with a palette.
Grid<std::uint16_t> read_palette_png(const std::string& path);

// A mask or label map as grey PNG of 8 bits, its numbers unchanged; read_grey reads them back.
// Error(output).
void write_grey_png(const std::string& path, const Grid<std::uint8_t>& grey);

// Writes numbers as a PNG with a palette, number k shown in colours[k]: viewable masks that
// read_grey reads as numbers. Numbers must be below the number of colours, which are at most 256.
// Error(output) where it cannot be written.
void write_palette_png(const std::string& path, const Grid<std::uint8_t>& numbers,
                       const std::vector<std::array<std::uint8_t, 3>>& colours);

// Whether a PNG is complete, with all checksums right.
bool is_png_complete(const std::string& path);
struct PngKind {
  int bits = 8;  // a channel, 1…16
  bool palette = false;
};
PngKind read_png_kind(const std::string& path);

}  // namespace belvedere::image_io
